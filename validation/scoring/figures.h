#pragma once
/// The lines of the table of targets.

#include "validation/scoring/score.h"

namespace rollrig::proof {

/// Source  docs/blind.md, "The proof"
std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options);

}  // namespace rollrig::proof
