#include "api/option_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rollrig/error.h"

namespace rollrig {

void require_within(const OptionRange& range, double value) {
  const double slack = 1e-12 * std::max(std::abs(range.lowest), std::abs(range.highest));
  if (value >= range.lowest - slack && value <= range.highest + slack) return;
  const std::string unit = *range.unit == '\0' ? "" : fmt::format(" {}", range.unit);
  throw InputError({fmt::format("{} is out of range", range.option), "command line", 0, range.option,
                    fmt::format("{:g}", value), fmt::format("{:.10g} to {:.10g}{}", range.lowest, range.highest, unit),
                    ""});
}

void require_threads(int threads) {
  constexpr int kMost = 1024;  // Assumed: more than any call can use
  if (threads >= 0 && threads <= kMost) return;
  throw InputError({"--threads is out of range", "command line", 0, "--threads", fmt::format("{}", threads),
                    fmt::format("0 (as many as the machine has) to {}", kMost), ""});
}

}  // namespace rollrig
