#pragma once
/// The port "trace" on channels that a test makes by hand.

#include <string>
#include <utility>
#include <vector>

#include "tests/support/hand_fed_corner.h"

namespace rollrig::tests {

template <class S>
void run_trace(const models::ActiveEffect& active, const models::Context<S>& context, models::TracePort<S>& port) {
  std::vector<S> parameters;
  for (std::size_t i = 0; i < active.parameters.size(); ++i) {
    parameters.push_back(
        quantity<S>(active.parameters[i], unit_of_key(active.effect->info.parameters[i].key).dimension));
  }
  port.context = &context;
  active.effect->hooks<S>().trace(models::EffectView<S>(parameters.data(), nullptr), port);
}

/// A channel by its heading in files, in SI.
using NamedChannel = std::pair<std::string, std::vector<double>>;

/// One channel after the effect; others beside it for the effect to read.
inline std::vector<double> apply_trace(const models::ActiveEffect& active, const std::vector<double>& time_s,
                                       const NamedChannel& channel, tests::Machine kind = tests::kDrum,
                                       const std::vector<NamedChannel>& others = {}) {
  const auto context = make_context_on(kind);
  models::TracePort<double> port;
  port.time_s = time_s;
  port.channels.push_back({intern_quantity(channel.first), channel.second});
  for (const auto& [header, values] : others) {
    if (!values.empty()) port.channels.push_back({intern_quantity(header), values});
  }
  run_trace(active, context, port);
  return port.channels.front().values;
}

}  // namespace rollrig::tests
