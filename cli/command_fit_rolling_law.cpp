#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/uncertain_result.h"
#include "rollrig/rolling_law.h"

namespace rollrig::cli {
namespace {

struct FitRollingLawOptions {
  std::string source;
  OutputOptions output;
  RollingLawOptions fit;
  std::optional<double> base_pressure_kPa;
  std::string form = "bilinear";
  UncertaintyOptions uncertainty;

  RollingLawOptions make_options() const {
    RollingLawOptions options = fit;
    if (base_pressure_kPa.has_value()) options.base_pressure_Pa = 1e3 * *base_pressure_kPa;
    return options;
  }
};

int fit_j2452_command(const FitRollingLawOptions& options) {
  Output output(options.output);
  output.show(make_uncertain("fit j2452", options.output, options.uncertainty,
                             [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
                               return fit_j2452(options.source, options.make_options(), uncertainty, progress);
                             }));
  return kDone;
}

int fit_j1269_command(const FitRollingLawOptions& options) {
  Output output(options.output);
  const bool proportional = options.form == "proportional";
  output.show(make_uncertain("fit j1269", options.output, options.uncertainty,
                             [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
                               return fit_j1269(options.source, options.make_options(), proportional, uncertainty,
                                                progress);
                             }));
  return kDone;
}

void add_rolling_law_options(CLI::App& command, FitRollingLawOptions& options) {
  command
      .add_option("points", options.source,
                  "CSV file with speed_km_h, load_N, pressure_kPa, rolling_resistance_N, or the folder or result.json "
                  "of a run")
      ->required();
  command
      .add_option("--maximum-load", options.fit.maximum_load_N,
                  "Maximum load of the tire, N, for the standard reference condition [that of the result]")
      ->check(shown_range(100.0, 100000.0));
  command
      .add_option("--base-pressure", options.base_pressure_kPa,
                  "Base pressure, kPa gauge, likewise [that of the result]")
      ->check(shown_range(50.0, 1500.0));
  command.add_flag("--warm-pressure", options.fit.warm_pressure,
                   "Of a result: take the pressure in the warm tire, not the one that was set cold");
  options.output.add_to(command, "File for fit.json, - for standard output", "Folder for fit.json and residuals.csv");
  options.output.add_report_to(command);
  add_uncertainty_options(command, options.uncertainty, true);
}

}  // namespace

void add_fit_rolling_laws(CLI::App& fit, Action& action) {
  const auto [j2452, options] = add_command<FitRollingLawOptions>(
      fit, action, "j2452", "Rolling resistance over speed, load and pressure by SAE J2452", &fit_j2452_command);
  add_rolling_law_options(*j2452, *options);
  j2452->add_option("--urban-cycle", options->fit.urban_cycle, "Cycle of the urban mean force [udds]");
  j2452->add_option("--highway-cycle", options->fit.highway_cycle, "Cycle of the highway mean force [hwfet]");
  const auto [j1269, multipoint] = add_command<FitRollingLawOptions>(
      fit, action, "j1269", "Rolling resistance over load and pressure at one speed (SAE J1269, ISO 18164)",
      &fit_j1269_command);
  add_rolling_law_options(*j1269, *multipoint);
  j1269
      ->add_option("--form", multipoint->form,
                   "bilinear: A0 + A1 Z + A2/P + A3 Z/P; proportional: Z (A1 + A3/P) [bilinear]")
      ->check(CLI::IsMember({"bilinear", "proportional"}));
}

}  // namespace rollrig::cli
