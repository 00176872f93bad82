#pragma once
/// The lines of the table of targets.

#include "validation/scoring/score.h"

namespace rollrig::validation {

/// Source  docs/validation.md, "Figures"
std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options);

}  // namespace rollrig::validation
