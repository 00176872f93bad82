#pragma once
/// A number of a tire's own model by its key.

#include <string>

#include "models/tire/tire.h"

namespace rollrig::models {

/// Pointer to the number, const where `own` is; nullptr where the model has none of that key. `key` is that of the
/// file, the number in SI units.
template <class Own>
auto find_own_number(Own& own, const std::string& key) {
  decltype(own.values.data()) found = nullptr;
  Own::visit(own, [&](const Field& field, auto& value) {
    if (field.key == key) found = &value;
  });
  return found;
}

}  // namespace rollrig::models
