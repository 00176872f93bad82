#pragma once
/// Laws of rolling resistance over speed, load and pressure (SAE J2452, SAE J1269), and their coefficients in the files
/// of other programs.

#include <optional>
#include <string>
#include <vector>

#include "progress.h"
#include "result.h"
#include "uncertainty_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

struct RollingLawOptions {
  std::optional<double> maximum_load_N;    // of the tire; absent: that of the result, else no reference condition
  std::optional<double> base_pressure_Pa;  // gauge; likewise
  bool warm_pressure = false;              // of results: the pressure in the warm tire, not the one that was set cold
  std::string urban_cycle = "udds";        // by name or path, for the mean equivalent rolling force
  std::string highway_cycle = "hwfet";
};

/// A fitted law. Its files: fit.json, residuals.csv. It has a test report.
struct RollingLaw : Report {
  std::vector<ParameterEstimate> coefficients;
  std::vector<std::string> warnings;
};

/// F = P^alpha Z^beta (a + b v + c v^2) from a CSV file of points or the result of the scenario sae_j2452. Method:
/// docs/fit_j2452.md.
/// Errors  InputError: a wrong file, too few points, speeds, loads or pressures; RunFailure: load and pressure that vary
///         together; Interrupted
RollingLaw fit_j2452(const std::string& path, const RollingLawOptions& options = {},
                     const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

/// F = A0 + A1 Z + A2/P + A3 Z/P, or with `proportional` F = Z (A1 + A3/P), from points at one speed. Method:
/// docs/fit_j2452.md.
/// Errors  as of fit_j2452; InputError also for points of several speeds
RollingLaw fit_j1269(const std::string& path, const RollingLawOptions& options = {}, bool proportional = false,
                     const UncertaintyOptions& uncertainty = {}, const Progress& progress = {});

/// Programs that take coefficients of rolling resistance.
enum class CoefficientTarget { kTydex, kTir, kSimscape, kFastsim, kCo2mpas };

struct CoefficientOptions {
  std::optional<double> tire_radius_m;  // unloaded, of a .tir file
  int tires = 4;                        // that share f0, f1, f2
};

/// The warnings of a fit of fit_j2452, from its fit.json. Throws InputError: another document.
std::vector<std::string> list_fit_warnings(const std::string& fit_json);

/// The file of another program from fit.json of fit_j2452. Content of the files: docs/fit_j2452.md.
/// Errors  InputError: another document, no reference condition, a radius that is missing
std::string export_coefficients(const std::string& fit_json, CoefficientTarget target,
                                const CoefficientOptions& options = {});

}  // namespace rollrig
#pragma GCC visibility pop
