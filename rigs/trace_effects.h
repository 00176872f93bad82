#pragma once
/// Port "trace": what effects do to the measured channels after a run.

#include <functional>
#include <optional>

#include "models/corner.h"
#include "sim/recording.h"

namespace rollrig::rigs {

/// What a recorded channel is to an effect; none for channels that are not its own to change.
using ChannelsOfEffects = std::function<std::optional<Quantity>(const Quantity& recorded)>;

/// Whether any effect that is on has a trace function.
template <class S>
bool has_trace_effects(const models::Corner<S>& corner) {
  for (const auto& on : corner.effects()) {
    if (on.hooks->trace != nullptr) return true;
  }
  return false;
}

/// Runs the trace functions of the effects that are on over the channels of a recording. Where several wheels are
/// recorded, it is called for each with its own channels.
template <class S>
void apply_trace_effects(
    const models::Corner<S>& corner, sim::Recording<S>& recording,
    const ChannelsOfEffects& find_own = [](const Quantity& recorded) { return recorded; });

}  // namespace rollrig::rigs
