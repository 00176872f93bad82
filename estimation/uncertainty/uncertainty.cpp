#include "estimation/uncertainty/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "include/rollrig/error.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

const char* distribution_name(Distribution distribution) {
  switch (distribution) {
    case Distribution::kRectangular:
      return "rectangular";
    case Distribution::kStudentT:
      return "Student's t";
    case Distribution::kMultivariateT:
      return "multivariate t";
    default:
      return "normal";
  }
}

Json contribution_to_json(const Contribution& line, const Unit& of_result) {
  const UncertainInput& input = line.input;
  const Unit unit = unit_of_key(input.key);
  return {{"name", input.name},
          {"key", input.key},
          {"value", line.is_group ? Json(nullptr) : Json(unit.from_si(input.value))},
          {"standard_uncertainty", line.is_group ? Json(nullptr) : Json(input.standard_uncertainty / unit.factor)},
          {"unit", unit.symbol},
          {"type", input.evaluation == Evaluation::kTypeA ? "A" : "B"},
          {"distribution", distribution_name(input.distribution)},
          {"degrees_of_freedom", finite_or_null(input.degrees_freedom)},
          {"sensitivity", line.is_group ? Json(nullptr) : Json(line.sensitivity * unit.factor / of_result.factor)},
          {"contribution", line.contribution / of_result.factor},
          {"share_percent", 100.0 * line.share},
          {"assumed", input.is_from_limits},
          {"source", input.source}};
}

Json budget_to_json(const UncertaintyBudget& budget) {
  const Unit unit = unit_of_key(budget.measurand.key);
  return {{"name", budget.measurand.name},
          {"key", budget.measurand.key},
          {"unit", unit.symbol},
          {"value", unit.from_si(budget.value)},
          {"combined_standard_uncertainty", budget.combined / unit.factor},
          {"effective_degrees_of_freedom", finite_or_null(budget.degrees_freedom)},
          {"coverage_factor", budget.coverage_factor},
          {"expanded_uncertainty", budget.expanded / unit.factor},
          {"contributions", make_list(budget.contributions,
                                      [&unit](const Contribution& line) { return contribution_to_json(line, unit); })}};
}

Json monte_carlo_to_json(const MonteCarloResult& result) {
  const Unit unit = unit_of_key(result.measurand.key);
  return {{"name", result.measurand.name},
          {"key", result.measurand.key},
          {"unit", unit.symbol},
          {"mean", result.has_mean ? Json(unit.from_si(result.mean)) : Json(nullptr)},
          {"standard_deviation", result.has_sd ? Json(result.sd / unit.factor) : Json(nullptr)},
          {"low_95", unit.from_si(result.low)},
          {"high_95", unit.from_si(result.high)},
          {"low_95_sd", result.low_sd / unit.factor},
          {"high_95_sd", result.high_sd / unit.factor},
          {"gum_low_95", unit.from_si(result.gum_low)},
          {"gum_high_95", unit.from_si(result.gum_high)},
          {"gum_tolerance", result.tolerance / unit.factor},
          {"gum_low_difference", result.low_difference / unit.factor},
          {"gum_high_difference", result.high_difference / unit.factor},
          {"gum", name_of(result.verdict)},
          {"trials_wanted", result.trials_wanted}};
}

std::string show_short(const Json& value) {
  return value.is_null() ? std::string("-") : fmt::format("{:.4g}", value.get<double>());
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// "5 million", or that no command makes so many.
std::string show_trials(double trials) {
  constexpr double kMillion = 1e6;
  if (trials > kMostTrials) return fmt::format("more than the most possible, {:.0f} million", kMostTrials / kMillion);
  return trials < kMillion ? fmt::format("{:.1g}", trials) : fmt::format("{:.1g} million", trials / kMillion);
}

Table make_budget_table(const Json& budget) {
  Table table;
  table.title =
      fmt::format("Uncertainty of {}: {}", budget["name"].get<std::string>(),
                  with_unit(fmt::format("{:.6g}", budget["value"].get<double>()), budget["unit"].get<std::string>()));
  table.columns = {"input", "u(x)", "", "c u(x)", "share %"};
  for (const Json& line : budget["contributions"]) {
    table.rows.push_back({line["name"].get<std::string>() + (line["assumed"].get<bool>() ? " *" : ""),
                          show_short(line["standard_uncertainty"]), line["unit"], show_short(line["contribution"]),
                          fmt::format("{:.1f}", line["share_percent"].get<double>())});
  }
  table.rows.push_back({"combined", "", "", show_short(budget["combined_standard_uncertainty"]), "100.0"});
  table.rows.push_back({fmt::format("expanded (95 %), k = {:.2f}", budget["coverage_factor"].get<double>()), "", "",
                        show_short(budget["expanded_uncertainty"]), ""});
  return table;
}

Table make_monte_carlo_table(const Json& json) {
  Table table;
  const int failed = json["failed_trials"].get<int>();
  table.title =
      fmt::format("Monte Carlo beside the GUM, {} trials{}, seed {}", json["trials"].get<int>(),
                  failed > 0 ? fmt::format(" ({} failed, left out)", failed) : "", json["seed"].get<std::uint64_t>());
  table.columns = {"result", "", "mean", "sd", "95 % from", "to", "GUM interval"};
  for (const Json& result : json["results"]) {
    const auto digits = [&result](const char* key) {
      return result[key].is_null() ? std::string("-") : fmt::format("{:.5g}", result[key].get<double>());
    };
    table.rows.push_back({result["name"], result["unit"], digits("mean"), show_short(result["standard_deviation"]),
                          digits("low_95"), digits("high_95"), result["gum"]});
  }
  return table;
}

Table make_remarks(const Json& json) {
  Table table;
  for (const Json& budget : json["budgets"]) {
    for (const Json& line : budget["contributions"]) {
      if (!line["assumed"].get<bool>()) continue;
      table.rows = {{"*",
                     "assumed, or the accuracy that a regulation asks for: put the figures of your instruments' "
                     "certificates in its place"}};
    }
  }
  for (const Json& budget : json["budgets"]) {
    const std::string doubt = doubt_budget(budget);
    if (!doubt.empty()) table.rows.push_back({budget["name"], doubt});
  }
  for (const Json& text : json["not_included"]) table.rows.push_back({"not included", text});
  if (json.contains("monte_carlo")) {
    for (const Json& result : json["monte_carlo"]["results"]) {
      table.rows.push_back({result["name"], describe_verdict(result)});
    }
  }
  return table;
}

}  // namespace

std::string doubt_budget(const Json& budget) {
  for (const Json& line : budget["contributions"]) {
    if (line["degrees_of_freedom"].is_null()) continue;
    const double alone =
        calc_coverage_factor(line["degrees_of_freedom"].get<double>()) * line["contribution"].get<double>();
    if (alone <= budget["expanded_uncertainty"].get<double>() * 1.0001) continue;
    return fmt::format(
        "the expanded uncertainty is smaller than that of one input alone ({}, {:.3g} degrees of freedom): too few for "
        "the equation of Welch and Satterthwaite; use the interval of Monte Carlo",
        line["name"].get<std::string>(), line["degrees_of_freedom"].get<double>());
  }
  return "";
}

const char* name_of(GumVerdict verdict) {
  switch (verdict) {
    case GumVerdict::kAgrees:
      return "agrees";
    case GumVerdict::kDiffers:
      return "differs";
    default:
      return "not decided";
  }
}

std::string describe_verdict(const Json& result) {
  const std::string unit = result["unit"].get<std::string>();
  const double most = std::max(result["gum_low_difference"].get<double>(), result["gum_high_difference"].get<double>());
  const std::string ends = fmt::format("the ends of the two intervals differ by up to {} (tolerance {})",
                                       with_unit(fmt::format("{:.2g}", most), unit),
                                       with_unit(fmt::format("{:.2g}", result["gum_tolerance"].get<double>()), unit));
  const std::string verdict = result["gum"].get<std::string>();
  if (verdict == "agrees") return "the interval of the GUM is validated: " + ends;
  if (verdict == "differs") return "the interval of the GUM is not validated, use that of Monte Carlo: " + ends;
  return fmt::format("not decided: {}; trials that would tell: {}", ends,
                     show_trials(result["trials_wanted"].get<double>()));
}

Uncertainty calc_uncertainty(const MeasurementModel& model, const UncertaintyRequest& request,
                             const UncertaintyProgress& progress) {
  const auto show = [&progress](const char* stage) {
    return [&progress, stage](double done) {
      if (progress) progress(done, stage);
    };
  };
  Uncertainty uncertainty;
  uncertainty.budgets = calc_budgets(model, show("uncertainty budget"));
  uncertainty.left_out = model.left_out;
  if (request.trials > 0) {
    uncertainty.monte_carlo = run_monte_carlo(model, uncertainty.budgets, request, show("Monte Carlo"));
  }
  return uncertainty;
}

Json make_uncertainty_json(const Uncertainty& uncertainty) {
  Json json;
  json["coverage_percent"] = 100.0 * kCoverage;
  json["budgets"] = make_list(uncertainty.budgets, budget_to_json);
  json["not_included"] = uncertainty.left_out;
  if (!uncertainty.monte_carlo.has_value()) return json;
  const MonteCarlo& monte_carlo = *uncertainty.monte_carlo;
  json["monte_carlo"] = {{"trials", monte_carlo.trials},
                         {"failed_trials", monte_carlo.failed},
                         {"seed", monte_carlo.seed},
                         {"results", make_list(monte_carlo.results, monte_carlo_to_json)}};
  return json;
}

std::vector<Table> make_uncertainty_tables(const Uncertainty& uncertainty) {
  const Json json = make_uncertainty_json(uncertainty);
  std::vector<Table> tables;
  for (const Json& budget : json["budgets"]) tables.push_back(make_budget_table(budget));
  if (json.contains("monte_carlo")) tables.push_back(make_monte_carlo_table(json["monte_carlo"]));
  Table remarks = make_remarks(json);
  if (!remarks.rows.empty()) tables.push_back(std::move(remarks));
  return tables;
}

void check_trials(int trials, const std::string& option) {
  if (trials == 0 || (trials >= kFewestTrials && trials <= kMostTrials)) return;
  throw InputError({"the number of trials is out of range", "command line", 0, option, std::to_string(trials),
                    fmt::format("{} to {}", kFewestTrials, kMostTrials), ""});
}

}  // namespace rollrig::estimation
