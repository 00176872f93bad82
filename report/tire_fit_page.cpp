#include <fmt/format.h>

#include <cmath>

#include "estimation/parameters.h"
#include "report/blocks.h"
#include "report/fit_pages.h"
#include "report/set_comparison.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::Estimate;
using estimation::TireFit;

/// Names of the estimates, in their order.
std::vector<std::string> name_estimates(const TireFit& fit) {
  std::vector<std::string> keys;
  for (const Estimate& at : fit.estimates) keys.push_back(estimation::find_file_key(at.key));
  return name_numbers(keys);
}

Table make_parameters(const TireFit& fit) {
  std::vector<ParameterEstimate> parameters = estimation::list_parameters(fit);
  const std::vector<std::string> names = name_estimates(fit);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].name = names[i] + (fit.estimates[i].nuisance ? " *" : "");
  }
  return make_estimate_table("Fitted, with standard uncertainty and 95 % interval (* beside a prior)", parameters);
}

/// What was known before, and how much of its uncertainty is left.
Table make_priors(const TireFit& fit) {
  Table table{
      "Priors (*) and the part of their uncertainty that is left", {"parameter", "prior", "sd", "from", "left"}, {}};
  const std::vector<std::string> names = name_estimates(fit);
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    const Estimate& at = fit.estimates[i];
    if (!at.prior.has_value()) continue;
    table.rows.push_back({names[i], fmt::format("{:.5g}", at.prior->value), fmt::format("{:.3g}", at.prior->sd),
                          at.prior->of_class ? "class" : "file",
                          fmt::format("{:.0f} %", 100.0 * at.sd / at.prior->sd)});
  }
  return table;
}

Table make_at_speeds(const TireFit& fit) {
  Table table{"At the speeds of the set, with standard uncertainty (tau: time constant)",
              {"km/h", "degC", "loss, N", "fall, 1/degC", "z + f v, W/K", "tau, s"},
              {}};
  for (const estimation::AtSpeed& speed : fit.at_speeds) {
    const auto number = [](const estimation::Uncertain& at) {
      return fmt::format("{:.4g} +- {:.2g}", at.value, at.sd);
    };
    table.rows.push_back({fmt::format("{:.0f}", unit_of_key("speed_km_h").from_si(speed.at.speed_m_s)),
                          fmt::format("{:.0f}", speed.at.temperature_K - kZeroCelsius_K), number(speed.loss_N),
                          number(speed.fall_per_K), number(speed.conductance_W_per_K), number(speed.time_constant_s)});
  }
  return table;
}

Table make_channels(const TireFit& fit) {
  Table table{"", {"channel", "samples", "rest, in units of the sensor's noise"}, {}};
  for (const estimation::ChannelFit& at : fit.channels) {
    table.rows.push_back(
        {plain_name(at.channel.header()), fmt::format("{}", at.samples), fmt::format("{:.3f}", at.whitened_rms)});
  }
  return table;
}

Table make_two_step(const TireFit& fit) {
  if (!fit.two_step.has_value()) {
    return {"", {}, {{"two-step regression", "left out: it is of A0 to B1, which this tire's law does not have"}}};
  }
  std::vector<std::string> numbers;
  const Json two_step = estimation::make_two_step_json(*fit.two_step);
  for (const auto& [key, value] : two_step.items()) {
    const std::string name = name_without_unit(key);
    numbers.push_back(value.is_null()
                          ? name + " not determined"
                          : fmt::format("{} {:.5g} {}", name, value.get<double>(), unit_of_key(key).symbol));
  }
  return {"", {}, {{"two-step regression", fmt::format("{} (start of the fit)", fmt::join(numbers, ", "))}}};
}

/// Each parameter beside its prior, with their intervals of 95 %.
Block make_forest(const TireFit& fit) {
  constexpr double kWide = 1.959963984540054;  // of a normal interval of 95 %
  Json rows = Json::array();
  const std::vector<std::string> names = name_estimates(fit);
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    const Estimate& at = fit.estimates[i];
    Json row = {{"name", names[i]},
                {"unit", shown_unit(last_part(estimation::find_file_key(at.key)))},
                {"value", rounded(at.value)},
                {"low", rounded(at.lower_95())},
                {"high", rounded(at.upper_95())}};
    if (at.prior.has_value()) {
      row["prior"] = {{"value", rounded(at.prior->value)},
                      {"low", rounded(at.prior->value - kWide * at.prior->sd)},
                      {"high", rounded(at.prior->value + kWide * at.prior->sd)}};
    }
    rows.push_back(std::move(row));
  }
  return {{"type", "forest"},
          {"label", "Estimates beside what was known before"},
          {"names", {"estimate", "before (file or class)"}},
          {"rows", rows},
          {"caption",
           "Lines: intervals of 95 %. All in percent of the estimate from the estimate; a number without a "
           "second line was not known before."}};
}

/// With so many decimals, or more where the uncertainty would be 0.
std::string show_uncertain(const estimation::Uncertain& at, double unit, int decimals) {
  constexpr int kMost = 6;
  while (decimals < kMost && at.sd > 0.0 && at.sd / unit < 0.5 * std::pow(10.0, -decimals)) ++decimals;
  const auto show = [&](double value) { return fmt::format("{:.{}f}", value / unit, decimals); };
  return show(at.value) + " +- " + show(at.sd);
}

Block make_steady_tiles(const TireFit& fit) {
  const estimation::SteadyTire& steady = fit.steady;
  const auto from = [](const char* key) -> std::vector<std::string> {
    return {fmt::format("/steady/{}/value", key), fmt::format("/steady/{}/sd", key)};
  };
  return make_tiles({{"RRc at 80 km/h and 25 degC", show_uncertain(steady.rrc, 1e-3, 3), "N/kN",
                      fmt::format("warm, at {:.0f} N and {:.0f} kPa; +- is one standard uncertainty", steady.at.load_N,
                                  unit_of_key("pressure_kPa").from_si(steady.at.pressure_Pa)),
                      "", from("rrc_N_per_kN")},
                     {"Falls with temperature by", show_uncertain(steady.fall_per_K, 1e-2, 2), "%/K",
                      fmt::format("of the loss, at {:.0f} degC, the temperature of the warm tire",
                                  unit_of_key("temperature_degC").from_si(steady.at.temperature_K)),
                      "", from("fall_percent_per_degC")},
                     {"Warm-up time constant", show_uncertain(steady.time_constant_s, 60.0, 1), "min", "at 80 km/h", "",
                      from("time_constant_min")},
                     {"Misfit of the model",
                      fmt::format("{:.2f}", std::sqrt(fit.chi2_per_sample)),
                      "",
                      "rms of the residuals over the noise of the sensors; about 1: the model lacks nothing",
                      "",
                      {"/rest_in_noise"}}});
}

/// What the fit found, in a sentence.
Block make_fit_lead(const TireFit& fit) {
  const estimation::SteadyTire& steady = fit.steady;
  return make_lead(
      "", fmt::format("Warm, at 80 km/h and 25 degC, the tire has an RRc of {} N/kN ({:.0f} N, {:.0f} kPa; +- is one standard uncertainty). Its loss "
                      "falls by {} % per K, and it warms up with a time constant of {} min.",
                      show_uncertain(steady.rrc, 1e-3, 3), steady.at.load_N,
                      unit_of_key("pressure_kPa").from_si(steady.at.pressure_Pa),
                      show_uncertain(steady.fall_per_K, 1e-2, 2), show_uncertain(steady.time_constant_s, 60.0, 1)));
}

Block make_correlations(const TireFit& fit) {
  Block block = {{"type", "map"},
                 {"caption", "Correlation of the estimates"},
                 {"heads", {"", "parameter"}},
                 {"columns", Json::array()},
                 {"rows", Json::array()},
                 {"legend", "Shade: size of the correlation."}};
  constexpr double kShade = 4.0;  // a correlation of 1 has the deepest shade
  const std::vector<std::string> names = name_estimates(fit);
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    block["columns"].push_back(names[i]);
    Json cells = Json::array();
    for (const double r : fit.correlation[i]) {
      cells.push_back({{"text", fmt::format("{:.2f}", r)}, {"shade", static_cast<int>(std::lround(kShade * r))}});
    }
    block["rows"].push_back({{"group", ""}, {"label", names[i]}, {"cells", cells}});
  }
  return block;
}

/// The context with every estimate put in, nuisances too.
models::Context<double> make_fitted_context(measurements::MeasurementSet set, const TireFit& fit) {
  set.tire = fit.tire;
  models::Context<double> context = measurements::make_context(set);
  for (const Estimate& at : fit.estimates) {
    estimation::find_parameter(context, at.key) = unit_of_key(last_part(at.key)).to_si(at.value);
  }
  return context;
}

/// The warnings with the names of the numbers in place of their keys.
std::vector<std::string> name_keys(std::vector<std::string> warnings, const TireFit& fit) {
  const std::vector<std::string> names = name_estimates(fit);
  for (std::string& warning : warnings) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string key = estimation::find_file_key(fit.estimates[i].key);
      if (warning.rfind(key + " ", 0) == 0) warning.replace(0, key.size(), capitalized(names[i]));
    }
  }
  return warnings;
}

}  // namespace

std::vector<Table> make_tire_fit_tables(const TireFit& fit) {
  return {make_parameters(fit), make_priors(fit), make_at_speeds(fit), make_channels(fit), make_two_step(fit)};
}

Page make_tire_fit_page(const measurements::MeasurementSet& set, const TireFit& fit) {
  Page page{
      "fit tire", fmt::format("Tire {} fitted to {}", fit.tire.name, name_set(set.name)),
      fmt::format("From tire {}, rig {}, {}", set.tire.name, set.rig->name, format_count(set.runs.size(), "run"))};
  const Json document = estimation::make_fit_json(set, fit);
  Section result = make_section("Result", make_tire_fit_tables(fit), name_keys(fit.warnings, fit));
  put_first({make_fit_lead(fit), make_steady_tiles(fit), make_forest(fit)}, result);
  page.add(std::move(result));
  const diagnosis::PreparedSet prepared(set);
  SimulatedSet fitted = simulate_set(prepared, "fit", make_fitted_context(prepared.source(), fit), {});
  for (const diagnosis::Series& series : prepared.series()) {
    const auto offset = fit.offsets_SI.find({series.run, prepared.channels()[series.channel]});
    if (offset == fit.offsets_SI.end() || fitted.values.empty()) continue;
    for (std::size_t k = 0; k < series.size(); ++k) fitted.values[series.first_residual + k] += offset->second;
  }
  Section runs{"Data, fit and residuals", "The fit is what the sensors would read, their fitted offsets included."};
  for (std::size_t run = 0; run < prepared.runs().size(); ++run) {
    runs.blocks.push_back(make_comparison(prepared, run, {fitted}));
  }
  page.add(std::move(runs));
  page.add({"Law of the tire", "", {make_equations("tire " + models::id_of(fit.tire.values.model()))}});
  page.add({"Correlations", "", {make_correlations(fit)}});
  page.add(make_document(document, "The fit as JSON"));
  return page;
}

}  // namespace rollrig::report
