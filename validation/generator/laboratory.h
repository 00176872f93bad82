#pragma once
/// Everything of a set but its files: what is driven with which sensors, and what they record.

#include <vector>

#include "validation/generator/campaign.h"
#include "validation/generator/effect.h"
#include "validation/generator/measurement_set.h"
#include "validation/generator/recorder.h"
#include "validation/generator/sensors.h"

namespace rollrig::generator {

using Columns = std::vector<std::vector<double>>;  // of the measured channels, by row; NaN: no sample

constexpr double kLeastForceSpeed_km_h = 20.0;  // formats.md: below it the force may be empty

struct Laboratory {
  Specimen specimen;
  Campaign campaign;
  Sensors sensors;
};

Laboratory draw_laboratory(const SetOrder& order);

/// The effects of an order with their sizes, forms and shapes; `described` gets what the truth says of them.
Effects draw_effects(const SetOrder& order, const Specimen& specimen, Json* described = nullptr);

/// All runs of a campaign. The records point to the specimen.
std::vector<RunRecord> record_all(const Specimen& specimen, const Campaign& campaign, const Effects& effects);

/// What perfect sensors would show in the measured channels.
Columns columns_of(const RunRecord& record);

/// What the loggers write of a run: with the errors of the sensors unless `noise_free`, the force empty at low speed
/// (unless its zero is read at standstill), all empty where the plan of the run says so.
Columns measure(std::uint64_t seed, const Laboratory& lab, const RunPlan& run, const RunRecord& record,
                bool noise_free);

/// Rows 30 s or more after each change of load, or before the first.
std::vector<bool> find_settled_rows(const RunRecord& record);

}  // namespace rollrig::generator
