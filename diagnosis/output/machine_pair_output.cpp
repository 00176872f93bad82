#include "diagnosis/output/machine_pair_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/output/summary.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

using rollrig::MachineDifference;
using rollrig::OnMachine;
using rollrig::PairFindings;
using rollrig::PairVerdict;
using rollrig::RrcEstimate;

constexpr std::size_t kPairLabelColumns = 14;
constexpr std::size_t kShownCauses = 4;
constexpr std::size_t kShownPlaces = 3;

std::string pair_line(const std::string& label, const std::string& text) {
  return text_columns({{fmt::format("{:<{}}", label, kPairLabelColumns), text}}, {false, 0});
}

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

const char* name_of_pair_verdict(PairVerdict verdict) {
  if (verdict == PairVerdict::kAgree) return "agree";
  return verdict == PairVerdict::kExplained ? "explained" : "unexplained";
}

double probability_in(const PairFindings& findings, const std::string& name) {
  const auto found = findings.probability.find(name);
  return found == findings.probability.end() ? 0.0 : found->second;
}

/// "load_record on B", or of two effects both.
std::string name_difference(const MachineDifference& cause, const PairWords& words = {}) {
  std::vector<std::string> names;
  for (const std::string& effect : cause.effects) {
    const auto on = std::find_if(cause.on_machine.begin(), cause.on_machine.end(),
                                 [&](const OnMachine& one) { return one.effect == effect; });
    names.push_back(on == cause.on_machine.end() ? words.name_of(effect) : name_with_machine(*on, words));
  }
  return fmt::format("{}", fmt::join(names, " + "));
}

std::string describe_sizes(const MachineDifference& cause) {
  std::vector<std::string> sizes;
  for (const ParameterEstimate& one : cause.parameters) {
    sizes.push_back(fmt::format("{} {:.3g}{}{} ({:.3g} to {:.3g}){}", one.name, one.value, one.unit.empty() ? "" : " ",
                                one.unit, one.low_95, one.high_95, describe_limit(one)));
  }
  return fmt::format("{}", fmt::join(sizes, "; "));
}

std::string describe_place(const Location& at) {
  return fmt::format("{} in {}, {}: {:+.2g} {}", plain_name(at.channel), at.run, at.phase, at.size, at.unit);
}

Json make_rrc_json(const RrcEstimate& estimate) {
  return {{"value_N_per_kN", json_number(estimate.value_N_per_kN)},
          {"ci95_N_per_kN", {json_number(estimate.low_95_N_per_kN), json_number(estimate.high_95_N_per_kN)}},
          {"half_width_95_N_per_kN", json_number(0.5 * (estimate.high_95_N_per_kN - estimate.low_95_N_per_kN))}};
}

Json make_difference_json(const MachineDifference& cause) {
  Json on_machine = Json::object();
  for (const OnMachine& one : cause.on_machine) {
    on_machine[one.effect] = {{"A", json_number(one.probability[0])}, {"B", json_number(one.probability[1])}};
  }
  Json parameters = Json::array();
  for (const ParameterEstimate& one : cause.parameters) {
    parameters.push_back({{"name", one.name},
                          {"value", json_number(one.value)},
                          {"ci95", {json_number(one.low_95), json_number(one.high_95)}},
                          {"unit", one.unit}});
  }
  return {{"effects", cause.effects},
          {"probability", json_number(cause.probability)},
          {"indistinguishable_from", cause.indistinguishable_from},
          {"on_machine", on_machine},
          {"parameters", parameters}};
}

}  // namespace

std::string name_with_machine(const OnMachine& on, const PairWords& words) {
  constexpr double kKnown = 0.9;
  const std::string effect = words.name_of(on.effect);
  const double sum = on.probability[0] + on.probability[1];
  if (!(sum > 0.0)) return effect;  // it acts on both alike, and their drums differ
  if (on.probability[0] >= kKnown * sum) return effect + " on A";
  return effect + (on.probability[1] >= kKnown * sum ? " on B" : " on A or B");
}

std::string show_rrc(const RrcEstimate& estimate) {
  return fmt::format("{:+.2f} N/kN ({:+.2f} to {:+.2f})", estimate.value_N_per_kN, estimate.low_95_N_per_kN,
                     estimate.high_95_N_per_kN);
}

std::string describe_pair_verdict(const PairFindings& findings, const PairWords& words) {
  const std::string unknown = show_probability(probability_in(findings, "unknown"));
  switch (findings.verdict) {
    case PairVerdict::kAgree: {
      const RrcEstimate& of = findings.difference;
      const double within = std::max(std::abs(of.low_95_N_per_kN), std::abs(of.high_95_N_per_kN));
      return fmt::format("{} agree, probability {}{}", words.machines, show_probability(probability_in(findings, "agree")),
                         std::isfinite(within) ? fmt::format(": within {:.2f} N/kN", within) : "");
    }
    case PairVerdict::kExplained:
      return fmt::format("{} differ in {}, probability {} (agree {}, unknown {})", words.machines,
                         name_difference(findings.causes.front(), words),
                         show_probability(findings.causes.front().probability),
                         show_probability(probability_in(findings, "agree")), unknown);
    case PairVerdict::kUnexplained:
      break;
  }
  if (!findings.doubt.empty()) return "unexplained: the files are in doubt, before any physics";
  return fmt::format("{} differ in an unknown effect, probability {}; no compared effect explains the difference", words.machines, unknown);
}

Table make_difference_table(const PairFindings& findings) {
  Table table{"", {"differ in", "probability", "on A", "on B", "cannot be told from"}, {}};
  for (std::size_t i = 0; i < std::min(findings.causes.size(), kShownCauses); ++i) {
    const MachineDifference& cause = findings.causes[i];
    const OnMachine on = cause.on_machine.empty() ? OnMachine{} : cause.on_machine.front();
    table.rows.push_back({fmt::format("{}", fmt::join(cause.effects, " + ")), show_probability(cause.probability),
                          show_probability(on.probability[0]), show_probability(on.probability[1]),
                          fmt::format("{}", fmt::join(cause.indistinguishable_from, ", "))});
  }
  return table;
}

std::string format_pair(const PairFindings& findings) {
  std::string text =
      pair_line("Machines", fmt::format("A {} ({}), B {} ({}), tire {}", findings.machines[0], findings.sets[0],
                                        findings.machines[1], findings.sets[1], findings.tire));
  text += pair_line("Verdict", describe_pair_verdict(findings));
  text += pair_line("RRc, A minus B", std::isfinite(findings.difference.value_N_per_kN)
                                         ? show_rrc(findings.difference) + " as measured"
                                         : "unknown: one of the machines has no constant speed under load");
  const bool is_named = findings.verdict == PairVerdict::kExplained;
  if (is_named && findings.remaining.has_value()) {
    text += pair_line("  remaining", show_rrc(*findings.remaining) + " with the effect");
  }
  if (is_named) {
    const MachineDifference& first = findings.causes.front();
    text += pair_line("Size", describe_sizes(first));
    if (!first.indistinguishable_from.empty()) {
      text += pair_line("Not told from", fmt::format("{}", fmt::join(first.indistinguishable_from, ", ")));
    }
  }
  if (findings.verdict != PairVerdict::kAgree) {
    std::vector<std::string> places;
    for (std::size_t i = 0; i < std::min(findings.where.size(), kShownPlaces); ++i) {
      places.push_back(describe_place(findings.where[i]));
    }
    if (!places.empty()) text += pair_line("Where", fmt::format("{}", fmt::join(places, "; ")));
  }
  if (findings.verdict == PairVerdict::kUnexplained && !findings.causes.empty()) {
    const MachineDifference& first = findings.causes.front();
    text += pair_line("Nearest",
                      fmt::format("{}, probability {}", name_difference(first), show_probability(first.probability)));
  }
  for (const std::string& warning : findings.warnings) text += pair_line("Warning", warning);
  return text;
}

Json make_pair_json(const PairFindings& findings) {
  Json probability = Json::object();
  for (const auto& [name, value] : findings.probability) probability[name] = json_number(value);
  Json causes = Json::array();
  for (const MachineDifference& cause : findings.causes) causes.push_back(make_difference_json(cause));
  Json where = Json::array();
  for (const Location& at : findings.where) {
    where.push_back({{"channel", at.channel},
                     {"run", at.run},
                     {"phase", at.phase},
                     {"share_percent", json_number(at.share_percent)},
                     {"size", json_number(at.size)},
                     {"unit", at.unit},
                     {"z", json_number(at.z)}});
  }
  return {{"format", "rollrig-pair/1"},
          {"machines",
           {{"A", {{"set", findings.sets[0]}, {"rig", findings.machines[0]}}},
            {"B", {{"set", findings.sets[1]}, {"rig", findings.machines[1]}}}}},
          {"tire", findings.tire},
          {"verdict", name_of_pair_verdict(findings.verdict)},
          {"probability", probability},
          {"causes", causes},
          {"rrc_difference", make_rrc_json(findings.difference)},
          {"rrc_remaining", findings.remaining.has_value() ? make_rrc_json(*findings.remaining) : Json(nullptr)},
          {"left_out_nats", findings.left_out_nats.has_value() ? json_number(*findings.left_out_nats) : Json(nullptr)},
          {"where", where},
          {"warnings", findings.warnings}};
}

PairFindings read_pair_json(const Json& json) {
  PairFindings read;
  const std::string verdict = json.at("verdict").get<std::string>();
  read.verdict = verdict == "agree"       ? PairVerdict::kAgree
                 : verdict == "explained" ? PairVerdict::kExplained
                                          : PairVerdict::kUnexplained;
  for (const auto& [name, value] : json.at("probability").items()) {
    read.probability[name] = value.is_number() ? value.get<double>() : std::nan("");
  }
  for (const Json& of : json.at("causes")) {
    MachineDifference cause;
    cause.effects = of.at("effects").get<std::vector<std::string>>();
    cause.probability = of.at("probability").get<double>();
    cause.indistinguishable_from = of.at("indistinguishable_from").get<std::vector<std::string>>();
    for (const auto& [effect, on] : of.at("on_machine").items()) {
      cause.on_machine.push_back({effect, {on.at("A").get<double>(), on.at("B").get<double>()}});
    }
    read.causes.push_back(std::move(cause));
  }
  const auto read_rrc = [](const Json& of) -> RrcEstimate {
    const Json& ci95 = of.at("ci95_N_per_kN");
    return {of.at("value_N_per_kN").get<double>(), ci95.at(0).get<double>(), ci95.at(1).get<double>()};
  };
  read.difference = read_rrc(json.at("rrc_difference"));
  if (json.at("rrc_remaining").is_object()) read.remaining = read_rrc(json.at("rrc_remaining"));
  return read;
}

}  // namespace rollrig::diagnosis
