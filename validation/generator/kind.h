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

/// What the runs of a dynamometer campaign are: as its laboratory has them, or all of one sort.
enum class DynoRuns { kAsUsual, kMultiCycle, kConstantSpeeds };

/// A campaign that a bank may have.
struct CampaignChoice {
  const char* name;  // "" where a bank has one kind alone
  Kind kind = Kind::kDrum;
  int runs = 6;  // at most
  DynoRuns dyno_runs = DynoRuns::kAsUsual;
};
constexpr std::array<CampaignChoice, 6> kMixedCampaigns{
    {{"full_drum", Kind::kDrum, 6},
     {"short_drum", Kind::kDrum, 3},
     {"dyno_multi_cycle", Kind::kDyno, 6, DynoRuns::kMultiCycle},
     {"dyno_constant_speed", Kind::kDyno, 6, DynoRuns::kConstantSpeeds},
     {"dyno_mixed", Kind::kDyno, 6},
     {"road", Kind::kRoad, 6}}};

}  // namespace blind
