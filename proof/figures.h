#pragma once
/// The lines of the table of targets.

#include <cstddef>

#include "proof/score.h"

namespace rollrig::proof {

constexpr std::size_t kTop = 3;  // places of "top-3"

/// Whether the effect is to be found: by d', or where that is not known by its signal.
bool is_detectable(const Case& one, const ScoreOptions& options);

/// Source  docs/blind.md, "Targets"
std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options);

}  // namespace rollrig::proof
