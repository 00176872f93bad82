#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "cli/uncertain_result.h"
#include "rollrig/fit.h"

namespace rollrig::cli {
namespace {

struct FitTireOptions {
  std::string set;
  OutputOptions output;
  TireFitOptions fit;
  BadRows bad_rows = BadRows::kRefuse;
};

struct FitDrumCoastdownOptions {
  std::string set;
  std::string data;
  OutputOptions output;
  BadRows bad_rows = BadRows::kRefuse;
  UncertaintyOptions uncertainty;
};

int fit_tire_command(const FitTireOptions& options) {
  const MeasurementSet set(options.set, options.bad_rows);
  Output output(options.output);
  TireFit fit;
  {  // its line is gone before the results are printed
    ProgressLine progress("fit tire", options.output.quiet);
    TireFitOptions how = options.fit;
    how.progress = progress.callback();
    fit = fit_tire(set, how);
  }
  output.show(fit);
  return fit.suspicion.empty() ? kDone : kDiffers;  // as of validate
}

int fit_drum_coastdown_command(const FitDrumCoastdownOptions& options) {
  Output output(options.output);
  output.show(make_uncertain("fit drum-coastdown", options.output, options.uncertainty,
                             [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
                               return fit_drum_coastdown(options.set, options.data, options.bad_rows, uncertainty,
                                                         progress);
                             }));
  return kDone;
}

void add_fit_drum_coastdown(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<FitDrumCoastdownOptions>(
      fit, action, "drum-coastdown", "Rolling resistance from coast-downs of a drum, tire loaded and lifted",
      &fit_drum_coastdown_command);
  command->add_option("set", options->set, "Set of coast-downs (.toml)")->required();
  command->add_option("--data", options->data, "Folder of the set's CSV files [that of the set]");
  options->output.add_to(*command, "File for fit.json, - for standard output",
                         "Folder for fit.json, decelerations.csv, residuals.csv");
  add_skip_bad_rows(*command, options->bad_rows);
  add_uncertainty_options(*command, options->uncertainty, true);
}

}  // namespace

void add_fit_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("fit", "Fit a model to measurements");
  command->require_subcommand(1);
  add_fit_road_load(*command, action);
  const auto [tire, options] = add_command<FitTireOptions>(
      *command, action, "tire", "The law of a tire's loss, z, f (and H) from one warm-up or several",
      &fit_tire_command);
  add_fit_drum_coastdown(*command, action);
  add_fit_rolling_laws(*command, action);
  add_fit_default_road_load(*command, action);
  tire->add_option("set", options->set, "Folder of a measurement set, or its set.toml")->required();
  tire->add_option("--name", options->fit.name, "Name of the fitted tire [<tire>_fit]");
  options->output.add_to(*tire, "File for fit.json, - for standard output", "Folder for the tire file and fit.json");
  tire->add_flag("--load-map", options->fit.load_map,
                 "Fit A0, A1, B0, B1 at each load of the set (tires whose law has them)");
  tire->add_flag("--free-h", options->fit.free_H, "Fit H even where the gas temperature was not measured");
  add_skip_bad_rows(*tire, options->bad_rows);
  add_threads(*tire, options->fit.threads);
}

}  // namespace rollrig::cli
