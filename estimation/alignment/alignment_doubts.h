#pragma once
/// What is not likely in the measurements of an alignment, though no rule forbids it.

#include <string>
#include <vector>

#include "estimation/alignment/alignment_file.h"

namespace rollrig::estimation {

/// A sentence for each doubt of the measured values. Nearly all used values of the candidate stand among those of the
/// same tire on the reference machine. All tires have the values of an earlier round, or of an earlier day, of the same
/// machine. The mean RRC of the tires of a class is not one of the class, as models::doubt_class_by_mean() says.
/// Coarse values are equal by chance. A copy is therefore doubted only where chance would hardly make it, as the other
/// equal values of the tires show.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_value_doubts(const AlignmentFile& file);

/// A sentence where measurements are dated after `today`, "2026-11-29" in UTC. One day more is allowed, because the
/// clock of a laboratory may be ahead of UTC.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_date_doubts(const AlignmentFile& file, const std::string& today);

}  // namespace rollrig::estimation
