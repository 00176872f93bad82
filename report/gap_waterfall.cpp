#include <fmt/format.h>

#include <algorithm>

#include "report/blocks.h"
#include "report/diagnosis_page.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

/// The steps as a waterfall; `size` gives what is left after a step.
template <class Size>
Block make_steps(const Axis& axis, const std::vector<GapStep>& steps, const std::string& caption, const Size& size) {
  std::vector<WaterfallBar> changes;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const std::string name = i == 1 ? "recalibration" : name_effect(steps[i].name);
    changes.push_back({name, size(steps[i]) - size(steps[i - 1])});
  }
  return make_waterfall(axis, {"with the files' numbers", size(steps.front())}, changes,
                        {"remains", size(steps.back())}, caption);
}

/// The first channel that measures a force: that of the rolling resistance. None where there is no such channel.
std::optional<std::size_t> find_force(const GapStep& step) {
  const auto at =
      std::find_if(step.channels.begin(), step.channels.end(), [](const ChannelRest& one) { return one.unit == "N"; });
  if (at == step.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(at - step.channels.begin());
}

std::string describe_energy(const std::vector<GapStep>& steps) {
  if (!steps.front().energy_percent.has_value() || !steps.back().energy_percent.has_value()) return "";
  return fmt::format(" The energy of a run is off by {:.2g} % with the files' numbers, and by {:.2g} % at the end.",
                     *steps.front().energy_percent, *steps.back().energy_percent);
}

}  // namespace

std::vector<Block> make_gap_waterfalls(const Gap& gap) {
  constexpr std::size_t kFewest = 2;  // the files' numbers, and one step
  if (gap.steps.size() < kFewest) return {};
  const std::string order =
      gap.steps.size() > kFewest + 1
          ? " Where effects overlap, the order matters: the first of them takes what each of them could."
          : "";
  const std::string how =
      "Root mean square of measured minus simulated, without noise and offsets, on the data that the fits saw. Each "
      "effect is added to those above it, and all numbers are fitted again." +
      order;
  std::vector<Block> blocks;
  const std::optional<std::size_t> force = find_force(gap.steps.front());
  if (force.has_value()) {
    const ChannelRest& channel = gap.steps.front().channels[*force];
    const bool is_torque = channel.channel.find("torque") != std::string::npos;
    const std::string label =
        "Gap of the " + plain_name(channel.channel) + (is_torque ? ", as force at the drum's surface" : "");
    blocks.push_back(make_steps({label, channel.unit}, gap.steps, how + describe_energy(gap.steps),
                                [&](const GapStep& step) { return step.channels[*force].rms; }));
  }
  if (force.has_value() && gap.steps.front().channels.size() == 1) return blocks;
  blocks.push_back(make_steps({"Gap over all channels", "noise floors"}, gap.steps,
                              force.has_value() ? "The same over all channels, each in its noise floors." : how,
                              [](const GapStep& step) { return step.floors; }));
  return blocks;
}

}  // namespace rollrig::report
