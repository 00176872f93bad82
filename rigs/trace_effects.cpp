#include "rigs/trace_effects.h"

#include <algorithm>
#include <utility>

namespace rollrig::rigs {

template <class S>
void apply_trace_effects(const models::Corner<S>& corner, sim::Recording<S>& recording) {
  const bool any = std::any_of(corner.effects().begin(), corner.effects().end(),
                               [](const auto& on) { return on.hooks->trace != nullptr; });
  if (!any) return;
  models::TracePort<S> trace;
  trace.context = &corner.context();
  trace.time_s = recording.time_s;
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    trace.channels.push_back({recording.channels[i].name, std::move(recording.values[i])});
  }
  for (const auto& on : corner.effects()) {
    if (on.hooks->trace != nullptr) on.hooks->trace(models::EffectView<S>(on.parameters.data(), nullptr), trace);
  }
  for (std::size_t i = 0; i < recording.channels.size(); ++i) recording.values[i] = std::move(trace.channels[i].values);
}

template void apply_trace_effects(const models::Corner<double>&, sim::Recording<double>&);
template void apply_trace_effects(const models::Corner<Jet>&, sim::Recording<Jet>&);

}  // namespace rollrig::rigs
