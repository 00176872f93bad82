#include "cli/coefficient_outputs.h"

#include <algorithm>

#include "cli/command.h"

namespace rollrig::cli {

void CoefficientOutputs::add_to(CLI::App& command) {
  add_output_option(command, "--tydex", tydex,
                    "Of a fit of J2452: file with its points as TYDEX; - for standard output");
  add_output_option(command, "--tir", tir,
                    "Likewise: tire property file (.tir) with QSY1 to QSY8; needs --tire-radius");
  add_output_option(command, "--simscape", simscape,
                    "Likewise: MATLAB script for the block Rolling Resistance of Simscape Driveline");
  add_output_option(command, "--fastsim", fastsim, "Likewise: wheel_rr_coef of FASTSim");
  add_output_option(command, "--co2mpas", co2mpas, "Likewise: rolling_resistance_coeff, f0, f1, f2 of CO2MPAS");
  command.add_option("--tire-radius", how.tire_radius_m, "Unloaded radius of the tire, m, for --tir")
      ->needs("--tir")
      ->check(shown_range(0.05, 2.0));
  command.add_option("--tires", how.tires, "Tires that share f0, f1, f2 of --co2mpas [4]")
      ->needs("--co2mpas")
      ->check(shown_range(1, 100));
}

std::vector<OutputFile> CoefficientOutputs::list_files() const {
  return {{"--tydex", tydex}, {"--tir", tir}, {"--simscape", simscape}, {"--fastsim", fastsim}, {"--co2mpas", co2mpas}};
}

bool CoefficientOutputs::are_empty() const {
  const std::vector<OutputFile> files = list_files();
  return std::all_of(files.begin(), files.end(), [](const OutputFile& file) { return file.path.empty(); });
}

std::vector<std::pair<std::string, std::string>> CoefficientOutputs::make(const std::string& fit_json) const {
  const std::vector<std::pair<std::string, CoefficientTarget>> targets{{tydex, CoefficientTarget::kTydex},
                                                                       {tir, CoefficientTarget::kTir},
                                                                       {simscape, CoefficientTarget::kSimscape},
                                                                       {fastsim, CoefficientTarget::kFastsim},
                                                                       {co2mpas, CoefficientTarget::kCo2mpas}};
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [path, target] : targets) {
    if (!path.empty()) files.emplace_back(path, export_coefficients(fit_json, target, how));
  }
  return files;
}

}  // namespace rollrig::cli
