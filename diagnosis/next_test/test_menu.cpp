#include "diagnosis/next_test/test_menu.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/error.h"

namespace rollrig::diagnosis {

void require_machine_hours(double hours) {
  constexpr double kLeast_h = 0.5;    // Assumed: no test takes less
  constexpr double kMost_h = 1000.0;  // Assumed: half a year of working days
  if (hours >= kLeast_h && hours <= kMost_h) return;
  throw InputError({"hours of the machine out of range", "command line", 0, "--hours", fmt::format("{:g}", hours),
                    fmt::format("{:g} to {:g}", kLeast_h, kMost_h), ""});
}

bool is_held_by_sets(const PlannedTest& test, const rigs::MachineKind& kind) {
  const std::vector<Quantity> columns = rigs::measured_channels(kind);
  return !test.clock_pulse &&
         std::all_of(test.extra.sensors.begin(), test.extra.sensors.end(), [&](const Quantity& sensor) {
           return std::find(columns.begin(), columns.end(), sensor) != columns.end();
         });
}

std::vector<PlannedTest> make_test_menu(const PreparedSet& set) { return set.kind().make_test_menu(set); }

}  // namespace rollrig::diagnosis
