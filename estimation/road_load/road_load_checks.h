#pragma once
/// Whether coastdowns keep to what SAE J1263, J2263 and UN GTR 15 ask for, and how they drift.

#include <string>
#include <vector>

#include "estimation/road_load/road_load_fit.h"
#include "estimation/road_load/session_statistics.h"

namespace rollrig::estimation {

enum class CheckStatus { kPass, kFail, kNotChecked };

struct RoadLoadCheck {
  std::string name;
  CheckStatus status = CheckStatus::kNotChecked;
  std::string found;   // with its unit; why, where it was not checked
  std::string limit;   // with its unit
  std::string clause;  // where the limit stands
};

struct RoadLoadChecks {
  std::vector<RoadLoadCheck> checks;
  std::vector<SessionDrift> drifts;
  std::vector<PairPrecision> precisions;
};

RoadLoadChecks check_road_load(const CoastdownData& data, const RoadLoadFit& fit);

}  // namespace rollrig::estimation
