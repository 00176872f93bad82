#pragma once
/// The kinds that there are, and their menus of tests. For the files of this folder alone: others ask kind_of().

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

#define ROLLRIG_MACHINE(word) const MeasurementKind& word##_kind();
#include "rigs/machines.def"
#undef ROLLRIG_MACHINE

std::vector<PlannedTest> make_drum_tests(const PreparedSet& set);
PlannedTest make_drum_sensor_test(const PreparedSet& set);
std::vector<PlannedTest> make_dyno_tests(const PreparedSet& set);
std::vector<PlannedTest> make_road_tests(const PreparedSet& set);

}  // namespace rollrig::diagnosis
