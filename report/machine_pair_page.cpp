#include "report/machine_pair_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/output/machine_pair_output.h"
#include "diagnosis/output/summary.h"
#include "report/blocks.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

constexpr std::size_t kMostBars = 8;

/// What differs: a torque is given as force at the surface of the drum.
std::string name_reading(const Location& at) {
  const bool is_torque = unit_of_key(at.channel).symbol != at.unit && at.unit == "N";
  return plain_name(at.channel) + (is_torque ? " (as force)" : "");
}

/// The difference of the coefficients, in a sentence; empty where it is not known.
std::string describe_rrc(const PairFindings& findings) {
  const RrcEstimate& at = findings.difference;
  if (!std::isfinite(at.value_N_per_kN)) return "";
  const bool shows_none = at.low_95_N_per_kN < 0.0 && at.high_95_N_per_kN > 0.0;
  return fmt::format("{}: RRc on A minus that on B is {:+.3f} +- {:.3f} N/kN (95 %).",
                     shows_none ? "No difference in RRc itself is shown" : "RRc differs as well", at.value_N_per_kN,
                     0.5 * (at.high_95_N_per_kN - at.low_95_N_per_kN));
}

/// The places with the largest share of the difference, the largest deviation first: readings of one channel.
Block make_place_bars(const PairFindings& findings) {
  const Location& first = findings.where.front();
  std::vector<Location> places;
  for (const Location& at : findings.where) {
    if (at.unit == first.unit && at.channel == first.channel && places.size() < kMostBars) places.push_back(at);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Location& a, const Location& b) { return std::abs(a.size) > std::abs(b.size); });
  Json names = Json::array(), values = Json::array();
  for (const Location& at : places) {
    names.push_back(fmt::format("{}, {}", at.run, at.phase));
    values.push_back(rounded(at.size));
  }
  return make_bars({capitalized(name_reading(first)) + ": measured minus simulated", first.unit}, names,
                   {{{"name", "measured minus simulated"}, {"values", values}}},
                   "Where the readings depart from the simulation of the same tire on both machines.");
}

bool names_cause(const PairFindings& findings) {
  return findings.verdict == PairVerdict::kExplained && !findings.causes.empty();
}

Block make_rrc_bars(const PairFindings& findings) {
  Json names = Json::array({"as measured"}), values = Json::array(), low = Json::array(), high = Json::array();
  const auto add = [&](const RrcEstimate& estimate) {
    values.push_back(rounded(estimate.value_N_per_kN));
    low.push_back(rounded(estimate.low_95_N_per_kN));
    high.push_back(rounded(estimate.high_95_N_per_kN));
  };
  add(findings.difference);
  if (findings.remaining.has_value() && names_cause(findings)) {
    names.push_back("the cause taken out");
    add(*findings.remaining);
  }
  return make_bars({"RRc on A minus RRc on B", "N/kN"}, names,
                   {{{"name", "difference, 95 % interval"}, {"values", values}, {"low", low}, {"high", high}}});
}

/// The likeliest entries of the probabilities.
Block make_probability_bars(const PairFindings& findings) {
  std::vector<std::pair<std::string, double>> sorted(findings.probability.begin(), findings.probability.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  if (sorted.size() > kMostBars) {  // the rest as one bar, so that all bars are the whole
    double rest = 0.0;
    for (std::size_t i = kMostBars - 1; i < sorted.size(); ++i) rest += sorted[i].second;
    sorted.resize(kMostBars - 1);
    sorted.emplace_back("all others", rest);
  }
  Json names = Json::array(), values = Json::array();
  for (const auto& [name, probability] : sorted) {
    names.push_back(plain_name(name));
    values.push_back(rounded(100.0 * probability));
  }
  return make_bars({"Probability", "%", true}, names, {{{"name", "probability"}, {"values", values}}},
                   "agree: nothing makes the machines differ. unknown: something outside the catalog.");
}

/// The verdict of the terminal as a sentence, with the names of effects in place of their ids.
std::string describe_pair(const PairFindings& findings) {
  return capitalized(diagnosis::describe_pair_verdict(findings, {"machines A and B", plain_name})) + ".";
}

Block make_pair_tiles(const PairFindings& findings) {
  std::vector<Tile> tiles;
  const auto probability = [&findings](const char* name) {
    const auto found = findings.probability.find(name);
    return diagnosis::show_probability(found != findings.probability.end() ? found->second : 0.0);
  };
  if (findings.verdict == PairVerdict::kAgree) {
    tiles.push_back({"Do they differ?", "no", "", "nothing beyond the noise", "good", {}});
    tiles.push_back({"How sure", probability("agree"), "", "probability that they agree", "", {"/probability/agree"}});
  } else if (findings.verdict == PairVerdict::kUnexplained || findings.causes.empty()) {
    tiles.push_back({"They differ in",
                     "an unknown effect",
                     "",
                     "no effect that was compared explains the difference",
                     "bad",
                     {}});
    tiles.push_back({"How sure",
                     probability("unknown"),
                     "",
                     "probability that they differ in an unknown effect",
                     "",
                     {"/probability/unknown"}});
  } else {
    const MachineDifference& cause = findings.causes.front();
    std::vector<std::string> names;
    for (const std::string& effect : cause.effects) names.push_back(plain_name(effect));
    std::string where = "on";
    for (const OnMachine& one : cause.on_machine) where += one.probability[0] > one.probability[1] ? " A" : " B";
    tiles.push_back({"They differ in", fmt::format("{}", fmt::join(names, " and ")), "", where, "good", {}});
    tiles.push_back({"How sure",
                     diagnosis::show_probability(cause.probability),
                     "",
                     "probability of this cause",
                     "",
                     {"/causes/0/probability"}});
  }
  const auto show = [](const RrcEstimate& at) {
    return fmt::format("{:+.3f} +- {:.3f}", at.value_N_per_kN, 0.5 * (at.high_95_N_per_kN - at.low_95_N_per_kN));
  };
  const bool shows_none = findings.difference.low_95_N_per_kN < 0.0 && findings.difference.high_95_N_per_kN > 0.0;
  if (!std::isfinite(findings.difference.value_N_per_kN)) return make_tiles(tiles);
  tiles.push_back(
      {"RRc on A minus RRc on B",
       show(findings.difference),
       "N/kN",
       shows_none ? "no difference in RRc is shown; +- is the interval of 95 %" : "+- is the interval of 95 %",
       "",
       {"/rrc_difference/value_N_per_kN", "/rrc_difference/half_width_95_N_per_kN"}});
  if (findings.remaining.has_value() && names_cause(findings)) {
    tiles.push_back({"Left of it without the cause",
                     show(*findings.remaining),
                     "N/kN",
                     "RRc on A minus RRc on B, the cause taken out",
                     "",
                     {"/rrc_remaining/value_N_per_kN", "/rrc_remaining/half_width_95_N_per_kN"}});
  }
  return make_tiles(tiles);
}

/// The table of the terminal, with the names of effects in place of their ids.
Table make_named_differences(const PairFindings& findings) {
  Table table = diagnosis::make_difference_table(findings);
  for (std::vector<std::string>& row : table.rows) {
    row.front() = plain_name(row.front());
    row.back() = plain_name(row.back());
  }
  return table;
}

Block make_parameter_table(const MachineDifference& cause) {
  Table table{"", {"parameter", "value", "95 % interval", "unit"}, {}};
  for (const ParameterEstimate& one : cause.parameters) {
    table.rows.push_back({plain_name(one.name), fmt::format("{:.3g}", one.value),
                          fmt::format("{:.3g} to {:.3g}", one.low_95, one.high_95), one.unit});
  }
  return make_table(table);
}

Block make_place_table(const PairFindings& findings) {
  Table table{"", {"channel", "run", "phase", "measured minus simulated", "unit", "share, %"}, {}};
  for (const Location& at : findings.where) {
    table.rows.push_back({name_reading(at), at.run, at.phase, fmt::format("{:+.2g}", at.size), at.unit,
                          fmt::format("{:.0f}", at.share_percent)});
  }
  return make_table(table);
}

}  // namespace

Page make_machine_pair_page(const PairFindings& findings) {
  Page page{"diagnose", "Two machines, tire " + findings.tire,
            fmt::format("A: {} ({}), B: {} ({})", findings.machines[0], findings.sets[0], findings.machines[1],
                        findings.sets[1])};
  Section verdict{"Verdict"};
  const char* tone = findings.verdict == PairVerdict::kUnexplained ? "bad" : "good";
  const bool agree = findings.verdict == PairVerdict::kAgree;
  verdict.blocks.push_back(make_lead(tone, describe_pair(findings), agree ? "" : describe_rrc(findings)));
  verdict.blocks.push_back(make_pair_tiles(findings));
  if (!findings.warnings.empty()) verdict.blocks.push_back(make_warnings(findings.warnings));
  const bool is_unknown = findings.verdict == PairVerdict::kUnexplained && !findings.where.empty();
  if (is_unknown) verdict.blocks.push_back(make_place_bars(findings));
  page.add(std::move(verdict));
  if (std::isfinite(findings.difference.value_N_per_kN)) {
    Section rrc{"Rolling resistance coefficient", "By how much the machines differ, and what remains"};
    rrc.blocks.push_back(make_rrc_bars(findings));
    page.add(std::move(rrc));
  }
  Section causes{"Effects in which they may differ"};
  if (!findings.causes.empty()) causes.blocks.push_back(make_table(make_named_differences(findings)));
  causes.blocks.push_back(make_probability_bars(findings));
  if (!findings.causes.empty()) causes.blocks.push_back(make_parameter_table(findings.causes.front()));
  page.add(std::move(causes));
  if (!findings.where.empty()) {
    page.add({"Where", "Against the simulation of the same tire on both machines", {make_place_table(findings)}});
  }
  return page;
}

}  // namespace rollrig::report
