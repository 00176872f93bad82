#pragma once
/// Phases of a run in which a vehicle is driven.

#include "diagnosis/comparison/run_phases.h"

namespace rollrig::diagnosis {

/// Phases by how fast it goes on average over two minutes: "standstill 1", "city 2" (below 50 km/h), "country 1" (below
/// 90 km/h), "motorway 1". A phase shorter than four minutes belongs to the one before it, or at the start to the next.
/// Where the run records a load, a change of it begins a phase.
/// Source    Assumed: all limits; a stop at a light is no phase, and ten of them in a row are one of traffic
/// Checked   tests/diagnosis/driving_phases_test.cpp
std::vector<RunPhase> find_driving_phases(const measurements::MeasuredRun& run);

}  // namespace rollrig::diagnosis
