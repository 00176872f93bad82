#pragma once
/// Published drive cycles, built in from the project's assets: speeds at whole seconds.

#include <string>
#include <vector>

namespace blind {

/// Speeds of the cycle called `name` in assets/cycles, in km/h, from time 0 on.
const std::vector<double>& cycle_km_h(const std::string& name);

}  // namespace blind
