#pragma once
/// Where an effect is to be found: on which machine, and on the road against which law.

#include <string>

namespace rollrig::generator {

using Grounds = unsigned;  // bits
constexpr Grounds kDrumGround = 1;
constexpr Grounds kDynoGround = 2;
constexpr Grounds kRoadGround = 4;      // against the combined law
constexpr Grounds kConstantGround = 8;  // road, against a constant coefficient
constexpr Grounds kNowhere = 0;
constexpr Grounds kRigGrounds = kDrumGround | kDynoGround;
constexpr Grounds kRoadGrounds = kRoadGround | kConstantGround;
constexpr Grounds kVehicleGrounds = kDynoGround | kRoadGrounds;
constexpr Grounds kEveryGround = kRigGrounds | kRoadGrounds;

/// As a message names them.
std::string list_grounds(Grounds grounds);

}  // namespace rollrig::generator
