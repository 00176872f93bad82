#include "estimation/road_load/reference_choice.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/core/text.h"

namespace rollrig::estimation {

InputError pairing_error(const std::string& what, const std::string& allowed) {
  return InputError({what, "", 0, "heading", "", allowed, ""});
}

ReferenceChoice::ReferenceChoice(const std::vector<ReferenceRun>& runs, const PairedRuns& paired,
                                 const std::vector<std::string>& windy, std::string quantity)
    : runs_(runs), paired_(paired), windy_(windy), quantity_(std::move(quantity)) {
  for (const ReferenceRun& run : runs) {
    if (run.heading == 0) continue;
    for (const auto& [speed, value] : run.values) ++(run.heading > 0 ? counts_[speed].plus : counts_[speed].minus);
  }
  for (const ReferencePair& pair : paired.pairs) {
    for (const int speed : pair.speeds) ++(pair.rejected.empty() ? counts_[speed].pairs : counts_[speed].rejected);
  }
  for (auto at = counts_.rbegin(); at != counts_.rend(); ++at) {
    if (at->second.pairs >= kFewestPairs) speeds_.push_back(at->first);
  }
}

void ReferenceChoice::require_enough(const std::map<int, double>& speeds_m_s) const {
  if (speeds_.empty()) {
    std::size_t most = 0;
    for (const auto& [speed, count] : counts_) most = std::max(most, count.pairs);
    throw pairing_error(
        fmt::format("fewer than {} pairs of opposite headings: {} (runs that repeat another are not used){}",
                    kFewestPairs, most, list_unused_runs()),
        "at least three runs of each heading at each reference speed, within the limits of the procedure");
  }
  if (speeds_.size() < kFewestSpeeds) {
    throw pairing_error(fmt::format("{} of {} pairs at {} only{}", quantity_, kFewestPairs,
                                    format_count(speeds_.size(), "reference speed"), list_unused_runs()),
                        fmt::format("at least {} reference speeds for f0, f1 and f2", kFewestSpeeds));
  }
  for (const auto& [speed, speed_m_s] : speeds_m_s) {
    if (speed < speeds_.back() || speed > speeds_.front()) continue;
    if (std::find(speeds_.begin(), speeds_.end(), speed) != speeds_.end()) continue;
    if (counts_.count(speed) == 0) {
      const std::string what =
          fmt::format("no run has {} at {} km/h, but runs have speeds above and below it", quantity_, speed);
      throw InputError({what, "", 0, "speed", "",
                        fmt::format("runs that pass {} and {} km/h: split runs have to overlap there", speed + 5,
                                    speed - 5),
                        ""});
    }
    throw pairing_error(fmt::format("fewer than {} pairs have {} at {} km/h, and there are enough above and below: {}",
                                    kFewestPairs, quantity_, speed, describe(speed)),
                        "three pairs at every reference speed; or a range by --speed-from and --speed-to");
  }
}

std::vector<std::string> ReferenceChoice::list_warnings() const {
  std::vector<int> above, below;  // rising; falling
  for (const auto& [speed, count] : counts_) {
    if (speed > speeds_.front()) above.push_back(speed);
    if (speed < speeds_.back()) below.insert(below.begin(), speed);
  }
  std::vector<std::string> warnings;
  if (!above.empty()) warnings.push_back(describe_end(above, speeds_.front(), "--speed-to"));
  if (!below.empty()) warnings.push_back(describe_end(below, speeds_.back(), "--speed-from"));
  return warnings;
}

std::string ReferenceChoice::describe(int speed) const {
  const auto found = counts_.find(speed);
  const Count count = found == counts_.end() ? Count() : found->second;
  const std::string rejected = count.rejected > 0 ? fmt::format(" and {} rejected", count.rejected) : "";
  return fmt::format("{}{}, of {} with + and {} with -", format_count(count.pairs, "pair"), rejected,
                     format_count(count.plus, "run"), count.minus);
}

std::string ReferenceChoice::describe_end(const std::vector<int>& speeds, int used, const char* option) const {
  std::vector<std::string> texts;
  for (std::size_t first = 0, next = 0; first < speeds.size(); first = next) {
    const std::string text = describe(speeds[first]);
    while (next < speeds.size() && describe(speeds[next]) == text) ++next;
    const std::string range = next - first > 1 ? fmt::format("{} to {}", speeds[first], speeds[next - 1])
                                               : fmt::format("{}", speeds[first]);
    texts.push_back(fmt::format("{} km/h ({})", range, text));
  }
  return fmt::format(
      "not used, since fewer than {} pairs have the reference speed in both of their runs: {}. More runs there make "
      "more pairs; {} {:g} leaves that out",
      kFewestPairs, fmt::join(texts, ", "), option, 0.5 * (speeds.front() + used));
}

std::string ReferenceChoice::list_unused_runs() const {
  std::vector<std::string> alone;
  for (const std::size_t run : paired_.alone) alone.push_back(runs_[run].name);
  std::string text;
  if (!alone.empty()) text += fmt::format("; without a partner in their session: {}", fmt::join(alone, ", "));
  if (!windy_.empty()) text += fmt::format("; rejected for their wind: {}. Is it in m/s?", fmt::join(windy_, ", "));
  return text;
}

}  // namespace rollrig::estimation
