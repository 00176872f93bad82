#include "diagnosis/next_test/test_menu.h"

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

bool is_held_by_sets(const PlannedTest& test, const rigs::MachineKind& kind) {
  const std::vector<Quantity> columns = rigs::measured_channels(kind);
  return !test.clock_pulse &&
         std::all_of(test.extra.sensors.begin(), test.extra.sensors.end(), [&](const Quantity& sensor) {
           return std::find(columns.begin(), columns.end(), sensor) != columns.end();
         });
}

std::vector<PlannedTest> make_test_menu(const PreparedSet& set) { return set.kind().make_test_menu(set); }

}  // namespace rollrig::diagnosis
