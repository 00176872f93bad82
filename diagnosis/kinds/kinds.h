#pragma once
/// The kinds that there are, their menus of tests, what those with a rig share, and the phases of a drive. For the
/// files of this folder and their tests: others ask kind_of().

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

/// What kinds of sets measured on a machine with a rig file have in common.
class KindWithRig : public MeasurementKind {
 public:
  Uncertainties find_uncertainties(const measurements::MeasurementSet& set,
                                   const models::Context<double>& context) const override {
    Uncertainties uncertainties;
    add_tire(set.tire, set.rig->cooling_rig(), context, true, uncertainties);
    add_parasitic_loss(*set.rig, uncertainties);
    return uncertainties;
  }

  double usual_ambient_K(const measurements::MeasurementSet& set) const override {
    return set.rig->environment.ambient_K;
  }
};

#define ROLLRIG_MACHINE(word) const MeasurementKind& word##_kind();
#include "rigs/machines.def"
#undef ROLLRIG_MACHINE

std::vector<PlannedTest> make_drum_tests(const PreparedSet& set);
PlannedTest make_drum_sensor_test(const PreparedSet& set);
std::vector<PlannedTest> make_dyno_tests(const PreparedSet& set);
std::vector<PlannedTest> make_road_tests(const PreparedSet& set);

/// Phases by how fast it goes on average over two minutes: "standstill 1", "city 2" (below 50 km/h), "country 1" (below
/// 90 km/h), "motorway 1". A phase shorter than four minutes belongs to the one before it, or at the start to the next.
/// Where the run records a load, a change of it begins a phase.
/// Source    Assumed: all limits; a stop at a light is no phase, and ten of them in a row are one of traffic
/// Checked   tests/diagnosis/driving_phases_test.cpp
std::vector<RunPhase> find_driving_phases(const measurements::MeasuredRun& run);

}  // namespace rollrig::diagnosis
