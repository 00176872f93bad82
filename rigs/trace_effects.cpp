#include "rigs/trace_effects.h"

#include <utility>

namespace rollrig::rigs {

template <class S>
void apply_trace_effects(const models::Corner<S>& corner, sim::Recording<S>& recording,
                         const ChannelsOfEffects& find_own) {
  if (!has_trace_effects(corner)) return;
  models::TracePort<S> trace;
  trace.context = &corner.context();
  trace.time_s = recording.time_s;
  trace.mean_bounds_s = recording.mean_bounds_s;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const std::optional<Quantity> own = find_own(recording.channels[i].quantity);
    if (!own.has_value()) continue;
    columns.push_back(i);
    trace.channels.push_back({*own, std::move(recording.values[i])});
  }
  for (const auto& on : corner.effects()) {
    if (on.hooks->trace != nullptr) on.hooks->trace(models::EffectView<S>(on.parameters.data(), nullptr), trace);
  }
  for (std::size_t k = 0; k < columns.size(); ++k) recording.values[columns[k]] = std::move(trace.channels[k].values);
}

template void apply_trace_effects(const models::Corner<double>&, sim::Recording<double>&, const ChannelsOfEffects&);
template void apply_trace_effects(const models::Corner<Jet>&, sim::Recording<Jet>&, const ChannelsOfEffects&);

}  // namespace rollrig::rigs
