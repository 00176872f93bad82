#pragma once
/// Sets of a vehicle on a dynamometer and on the road, simulated with a known difference from the baseline.

#include <functional>
#include <vector>

#include "measurements/measurement_set.h"
#include "models/effect.h"

namespace rollrig::tests {

/// Runs on the asset dynamometer, tire a50: a driven wheel of the source's car through the assets' cycles, cold and
/// warm, with steady stretches between; free of noise, default sensors. Up to four runs at 1 Hz, of about `minutes`
/// each.
measurements::MeasurementSet make_dyno_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                           models::Baseline baseline = models::Baseline::kCombined,
                                           double minutes = 60.0);

/// Drives of the source's car over hills, at several ambient temperatures, the last but one right after another; free
/// of noise, default sensors. Up to six runs at 1 Hz of half an hour. Against the constant coefficient the tire's file
/// has what formats.md asks for and no more.
measurements::MeasurementSet make_road_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                           models::Baseline baseline = models::Baseline::kConstantRrc);

/// Measures a set again: its measured columns become what its sensors would have shown with these effects on, without
/// noise. `change` may move base parameters before.
void measure_again(measurements::MeasurementSet& set, const std::vector<models::ActiveEffect>& effects,
                   const std::function<void(models::Context<double>&)>& change = {});

/// The run with every step-th of its rows.
measurements::MeasuredRun thin_out(const measurements::MeasuredRun& run, std::size_t step);

}  // namespace rollrig::tests
