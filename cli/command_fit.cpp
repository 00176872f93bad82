#include <fmt/format.h>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "cli/progress.h"
#include "diagnosis/checks/set_checks.h"
#include "estimation/parameters.h"
#include "estimation/tire_fit/fit_tire.h"
#include "report/fit_pages.h"
#include "sim/core/error.h"

namespace rollrig::cli {
namespace {

struct Options {
  std::string set;
  OutputOptions output;
  std::string name;
  bool load_map = false;
  bool free_H = false;
  int threads = 0;
};

/// A key without its table in the tire file, so that a row fits a terminal; no two keys of these tables are alike.
std::string drop_table(const std::string& key) {
  for (const std::string& table : {std::string("rolling_resistance."), std::string("thermal.")}) {
    if (key.rfind(table, 0) == 0) return key.substr(table.size());
  }
  return key;
}

scenarios::ResultTable make_table(const estimation::TireFit& fit) {
  scenarios::ResultTable table{"Fitted, with standard uncertainty and 95 % interval (* beside a prior)",
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

std::string format_fit(const measurements::MeasurementSet& set, const estimation::TireFit& fit) {
  std::string text = fmt::format("fit tire   set {}   tire {}   rig {}\n", set.name, set.tire.name, set.rig->name);
  text += format_table(make_table(fit));
  for (const estimation::ChannelFit& channel : fit.channels) {
    text += fmt::format("  {:<24} {:>7} samples, rest {:.3f} of the sensor's noise\n", channel.channel, channel.samples,
                        channel.whitened_rms);
  }
  const estimation::TwoStepEstimate& two_step = fit.two_step;
  text += wrap(fmt::format("two-step regression of the source (start of the fit): A0 {:.4g} N, A1 {:.4g} N s/m, B0 "
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
estimation::TireFit fit_checked(const measurements::MeasurementSet& set, const estimation::FitOptions& options,
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

int fit_tire_command(const Options& options) {
  measurements::MeasurementSet set = measurements::read_measurement_set(options.set);
  Output output(options.output);
  estimation::FitOptions fit_options;
  fit_options.load_map = options.load_map;
  fit_options.threads = options.threads;
  if (options.free_H) fit_options.free_H = true;
  ProgressLine progress("fit tire", options.output.quiet);
  fit_options.progress = [&progress](int iteration) { progress.show(fmt::format("iteration {}", iteration)); };
  const diagnosis::SetChecks checks = diagnosis::check_set(set, options.threads);
  const std::string& suspicion = checks.suspicion;
  set = diagnosis::leave_out(std::move(set), checks.left_out);
  estimation::TireFit fit = fit_checked(set, fit_options, suspicion);
  if (!checks.left_out.empty()) {
    fit.warnings.emplace_back(
        "samples of stuck sensors or that stand alone were left out: rollrig validate tells which");
  }
  fit.tire.name = options.name.empty() ? set.tire.name + "_fit" : options.name;
  const std::string json = to_text(estimation::make_fit_json(set, fit));
  output.write({{fit.tire.name + ".toml", models::write_tire(fit.tire, fit.notes)}, {"fit.json", json}}, json,
               [&] { return report::make_tire_fit_page(set, fit); });
  output.print(format_fit(set, fit));
  return suspicion.empty() ? kDone : kDiffers;  // as of validate
}

}  // namespace

void add_fit_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("fit", "Fit a model to measurements");
  command->require_subcommand(1);
  add_fit_road_load(*command, action);
  const auto [tire, options] = add_command<Options>(
      *command, action, "tire", "A0, A1, B0, B1, z, f (and H) from warm-ups at two or more speeds", &fit_tire_command);
  add_fit_drum_coastdown_command(*command, action);
  tire->add_option("set", options->set, "Folder of a measurement set, or its set.toml")->required();
  tire->add_option("--name", options->name, "Name of the fitted tire [<tire>_fit]");
  options->output.add_to(*tire, "File for fit.json, - for standard output", "Folder for the tire file and fit.json");
  tire->add_flag("--load-map", options->load_map, "Fit A0, A1, B0, B1 at each load of the set");
  tire->add_flag("--free-h", options->free_H, "Fit H even where the gas temperature was not measured");
  tire->add_option("--threads", options->threads, "Threads [as many as the machine has]")->check(CLI::Range(1, 1024));
}

}  // namespace rollrig::cli
