#pragma once
/// Kinds of measurement sets, and on which of them an effect is to be found.

#include <array>
#include <string>

namespace blind {

/// What a set was measured on.
enum class Kind { kDrum, kDyno, kRoad };
constexpr std::array<const char*, 3> kKindNames{"drum", "dyno", "road"};

inline const char* name_of(Kind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

/// Ground of a set: its kind, and for a road set the law that the simulator is to have before any effect.
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

inline Grounds grounds_of(Kind kind) {
  constexpr std::array<Grounds, 3> kGrounds{kDrumGround, kDynoGround, kRoadGrounds};
  return kGrounds[static_cast<std::size_t>(kind)];
}

}  // namespace blind
