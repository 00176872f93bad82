#pragma once
/// The lines of the table of targets.

#include "validation/scoring/score.h"

namespace rollrig::validation {

/// What the answers state, of the cases that could be diagnosed.
std::vector<Stated> list_stated(const std::vector<Case>& cases);

/// Source  docs/validation.md, "Figures"
std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options);

}  // namespace rollrig::validation
