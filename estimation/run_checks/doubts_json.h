#pragma once
/// Doubts about runs in result files.

#include "estimation/run_checks/run_doubt.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

inline Json make_doubts_json(const std::vector<RunDoubt>& doubts) {
  return make_list(doubts, [](const RunDoubt& doubt) {
    Json json = {{"kind", name_of(doubt.kind)}, {"runs", doubt.runs}, {"text", doubt.text}};
    if (!doubt.likely.empty()) json["likely"] = doubt.likely;
    if (doubt.relative != 0.0) json["off_by"] = doubt.relative;
    return json;
  });
}

}  // namespace rollrig::estimation
