#pragma once
/// A state of a wheel as bytes, for an importer that keeps it.

#include <cstddef>
#include <limits>
#include <vector>

#include "fmu/warm_wheel.h"

namespace rollrig::fmu {

/// A snapshot, and what its instance knew beside it.
struct SavedState {
  Snapshot wheel;
  int stage = 0;
  double start_s = 0.0;
  double stop_s = std::numeric_limits<double>::infinity();
};

std::size_t count_bytes(const SavedState& state);
std::vector<char> serialize(const SavedState& state);
/// Throws InputError where the bytes are not those of serialize(), for any reason.
SavedState deserialize(const char* bytes, std::size_t size);

}  // namespace rollrig::fmu
