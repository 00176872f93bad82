#include <fmt/format.h>

#include "api/data.h"
#include "diagnosis/checks/set_checks.h"
#include "estimation/parameters.h"
#include "report/fit_pages.h"
#include "report/text.h"
#include "rollrig/fit.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

/// A key without its table in the tire file, so that a row fits a terminal; no two keys of these tables are alike.
std::string drop_table(const std::string& key) {
  for (const std::string& table : {std::string("rolling_resistance."), std::string("thermal.")}) {
    if (key.rfind(table, 0) == 0) return key.substr(table.size());
  }
  return key;
}

Table make_table(const estimation::TireFit& fit) {
  Table table{"Fitted, with standard uncertainty and 95 % interval (* beside a prior)",
              {"parameter", "value", "sd", "from", "to"},
              {}};
  for (const estimation::Estimate& estimate : fit.estimates) {
    const auto number = [](double value) { return fmt::format("{:.4g}", value); };
    table.rows.push_back({drop_table(estimation::find_file_key(estimate.key)) + (estimate.nuisance ? " *" : ""),
                          number(estimate.value), number(estimate.sd), number(estimate.lower_95()),
                          number(estimate.upper_95())});
  }
  return table;
}

std::string format_tire_fit(const measurements::MeasurementSet& set, const estimation::TireFit& fit) {
  std::string text = fmt::format("fit tire   set {}   tire {}   rig {}\n", set.name, set.tire.name, set.rig->name);
  text += format_table(make_table(fit));
  Table channels{"", {"channel", "samples", "rest, in units of the sensor's noise"}, {}};
  for (const estimation::ChannelFit& channel : fit.channels) {
    channels.rows.push_back(
        {channel.channel.header(), std::to_string(channel.samples), fmt::format("{:.3f}", channel.whitened_rms)});
  }
  text += format_table(channels);
  const estimation::TwoStepEstimate& two_step = fit.two_step;
  text += wrap(fmt::format("two-step regression (start of the fit): A0 {:.4g} N, A1 {:.4g} N s/m, B0 "
                           "{:.4g} 1/degC, B1 {:.4g} s/(m degC), z {:.4g} W/K, f {:.4g} W s/(m K){}",
                           two_step.A0_N, two_step.A1_N_s_per_m, two_step.B0_per_K, two_step.B1_s_per_m_K,
                           two_step.rest_conductance_W_per_K, two_step.speed_conductance_W_s_per_m_K,
                           two_step.H_gas_W_per_K.has_value() ? fmt::format(", H {:.4g} W/K", *two_step.H_gas_W_per_K)
                                                              : std::string()),
               2);
  for (const std::string& warning : fit.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

/// A fit follows whatever the columns say, so a suspicion that they say another thing is told beside its numbers, or
/// beside the error that comes of it.
estimation::TireFit fit_checked(const measurements::MeasurementSet& set, const TireFitOptions& options,
                                const std::string& suspicion) {
  try {
    estimation::TireFit fit = estimation::fit_tire(set, options);
    if (!suspicion.empty()) fit.warnings.push_back(suspicion + ". Then the fitted numbers are wrong");
    return fit;
  } catch (const RunFailure& failure) {
    if (suspicion.empty()) throw;
    throw RunFailure(fmt::format("{}; {}", failure.what(), suspicion));
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (!suspicion.empty()) problem.what += "; " + suspicion;
    throw InputError(problem);
  }
}

}  // namespace

TireFit fit_tire(const MeasurementSet& measured, const TireFitOptions& options) {
  const diagnosis::SetChecks checks = diagnosis::check_set(measured.data().set, options.threads);
  const auto set =
      std::make_shared<const measurements::MeasurementSet>(diagnosis::leave_out(measured.data().set, checks.left_out));
  const auto fit = std::make_shared<estimation::TireFit>(fit_checked(*set, options, checks.suspicion));
  if (!checks.left_out.empty()) {
    fit->warnings.emplace_back(
        "samples of stuck sensors or that stand alone were left out: rollrig validate tells which");
  }
  fit->tire.name = options.name.empty() ? set->tire.name + "_fit" : options.name;
  TireFit result;
  for (const estimation::Estimate& at : fit->estimates) {
    const std::string key = estimation::find_file_key(at.key);
    result.parameters.push_back(
        {key, at.value, at.sd, at.lower_95(), at.upper_95(), unit_of_key(key.substr(key.rfind('.') + 1)).symbol});
  }
  result.warnings = fit->warnings;
  result.suspicion = checks.suspicion;
  result.text = format_tire_fit(*set, *fit);
  result.json = to_text(estimation::make_fit_json(*set, *fit));
  result.make_files = [fit, json = result.json] {
    return FolderFiles{{fit->tire.name + ".toml", models::write_tire(fit->tire, fit->notes)}, {"fit.json", json}};
  };
  result.make_page = [set, fit] { return report::make_html(report::make_tire_fit_page(*set, *fit)); };
  return result;
}

}  // namespace rollrig
