#pragma once
/// The kinds that there are, and their menus of tests. For the files of this folder alone: others ask kind_of().

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

const MeasurementKind& drum_kind();
const MeasurementKind& dyno_kind();
const MeasurementKind& road_kind();

std::vector<PlannedTest> make_drum_tests(const PreparedSet& set);
PlannedTest make_drum_sensor_test(const PreparedSet& set);
std::vector<PlannedTest> make_dyno_tests(const PreparedSet& set);
std::vector<PlannedTest> make_road_tests(const PreparedSet& set);

}  // namespace rollrig::diagnosis
