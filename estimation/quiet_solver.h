#pragma once
/// What Ceres says by itself.

namespace rollrig::estimation {

/// From now on Ceres writes nothing to standard error: what it says of a step or of the data, an error or an answer of
/// rollrig says. May be called from any thread, as often as one likes.
void quiet_solver();

}  // namespace rollrig::estimation
