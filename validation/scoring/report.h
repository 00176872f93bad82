#pragma once
/// A score as text for a terminal, as tables of a page, as JSON.

#include <string>
#include <vector>

#include "sim/core/columns.h"
#include "sim/core/json.h"
#include "validation/scoring/score.h"

namespace rollrig::validation {

/// The tables of make_score_tables, as wide as the terminal.
std::string format_score(const Score& score);
/// Figures, baselines, cases by effect, campaign and size, confusions, reliability, follow-up tests, what was missed;
/// those with rows.
std::vector<Table> make_score_tables(const Score& score);
std::string format_score_markdown(const Score& score);
/// rollrig-blind-score/1.
Json make_score_json(const Score& score);

/// Value of a figure in its unit, "-" where there is none.
std::string format_value(const Figure& figure, const std::optional<double>& value);
/// Interval of a share in %, "" where there is none.
std::string format_interval(const std::optional<Interval>& share);
/// Value of a baseline's figure.
std::optional<double> find_value(const BaselineScore& baseline, const Figure& figure);
/// What a case's data and answer are, in one sentence each.
std::string describe_truth(const Case& one);
std::string describe_answer(const Case& one);
/// Cases whose causes could not be told apart, their next tests, and what came of them.
std::vector<Table> make_follow_up_tables(const Score& score);
Json make_follow_ups_json(const Score& score);

}  // namespace rollrig::validation
