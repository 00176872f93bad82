#include "diagnosis/checks/tire_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/resimulation.h"
#include "measurements/sample_selection.h"
#include "sim/core/assets.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kOddPressure = 1.7;  // tires are tested within this factor of their reference
constexpr double kOddLoad = 2.0;      // likewise
constexpr double kOddLevel = 0.15;    // three times the usual uncertainty of a tire's loss
constexpr double kFarBetter = 0.15;   // of the sum of squares
constexpr double kVisible = 0.02;     // sum of squares a run below which there is nothing to mend

/// Measured and simulated rolling resistance of steady rows under load, summed over a set.
struct Level {
  double measured_N = 0.0;
  double simulated_N = 0.0;
};

void add_level(const MeasurementSet& set, const MeasuredRun& run, const sim::Recording<double>& simulated,
               Level& level) {
  const MeasurementKind& kind = kind_of(set);
  const Quantity& force = set.kind->traits.force;
  const double loaded_N = measurements::kLoadedShare * set.tire.values.rolling_resistance.reference_load_N;
  if (!run.has(models::quantities::kLoad)) return;
  for (const std::size_t row : find_compared_rows(set, run, force)) {
    const bool steady = std::abs(measurements::find_acceleration(run, row)) <= measurements::kSteadyAcceleration_m_s2;
    if (!steady || run.column(models::quantities::kLoad)[row] <= loaded_N) continue;
    const auto measured_N = kind.find_tire_force_N(set, run, row, run.column(force)[row]);
    const auto simulated_N = kind.find_tire_force_N(set, run, row, simulated.channel(force)[row]);
    if (!measured_N.has_value() || !simulated_N.has_value()) return;
    level.measured_N += *measured_N;
    level.simulated_N += *simulated_N;
  }
}

void check_level(const MeasurementSet& set, const BaselineRuns& baseline, std::vector<std::string>& warnings) {
  Level level;
  for (std::size_t r = 0; r < set.runs.size(); ++r) add_level(set, set.runs[r], baseline.recordings[r], level);
  if (level.simulated_N <= 0.0) return;
  const double off = level.measured_N / level.simulated_N - 1.0;
  if (std::abs(off) <= kOddLevel) return;
  warnings.push_back(
      fmt::format("the tire's loss under load is {:.0f} % {} that of its file, with the rig's own as its file has it: "
                  "was it tire {}?",
                  100.0 * std::abs(off), off > 0.0 ? "above" : "below", set.tire.name));
}

/// A tire of the assets as it would cool where the set's tire was run: in proportion to its outer area.
models::TireFile read_tire_on_rig(const std::string& name, const MeasurementSet& set) {
  models::TireFile tire = models::read_tire(read_config(find_asset("tires", name)));
  const auto& cooling = measurements::make_context(set).tire.thermal;
  const double area_ratio =
      models::calc_outer_area_m2(tire.values.geometry) / models::calc_outer_area_m2(set.tire.values.geometry);
  tire.rig_thermal.clear();
  tire.values.thermal.rest_conductance_W_per_K = area_ratio * cooling.rest_conductance_W_per_K;
  tire.values.thermal.speed_conductance_W_s_per_m_K = area_ratio * cooling.speed_conductance_W_s_per_m_K;
  return tire;
}

/// Another tire of the assets, of another size, that fits the set far better as it stands.
void check_other_tires(const MeasurementSet& set, const BaselineRuns& baseline, int threads,
                       std::vector<std::string>& warnings) {
  const auto sum_of = [](const std::vector<RunMisfit>& misfits) {
    double sum = 0.0;
    for (const RunMisfit& misfit : misfits) sum += misfit.sum_of_squares();
    return sum;
  };
  if (!set.tire.model(set.baseline).info.loss_follows_heat) return;  // a coefficient alone does not tell tires apart
  const double own = sum_of(baseline.misfits);
  if (own < kVisible * static_cast<double>(set.runs.size())) return;
  for (const std::string& name : list_assets("tires")) {
    MeasurementSet other = set;
    other.tire = read_tire_on_rig(name, set);
    const bool whole = other.tire.has_rolling_resistance && other.tire.has_thermal;
    if (!whole || other.tire.designation == set.tire.designation) continue;
    if (sum_of(resimulate_baseline(other, threads).misfits) > kFarBetter * own) continue;
    warnings.push_back(fmt::format("tire {} ({}) fits these runs far better than tire {} ({}): was it that one?", name,
                                   other.tire.designation, set.tire.name, set.tire.designation));
  }
}

}  // namespace

std::vector<std::string> check_tire_conditions(const MeasurementSet& set) {
  std::vector<std::string> warnings;
  const auto& reference = set.tire.values.rolling_resistance;
  std::vector<std::size_t> odd_pressure;
  std::vector<std::size_t> odd_load;
  for (std::size_t r = 0; r < set.runs.size() && set.tire.has_rolling_resistance; ++r) {
    const double pressure = set.runs[r].cold_pressure_Pa / reference.reference_pressure_Pa;
    if (pressure > kOddPressure || pressure < 1.0 / kOddPressure) odd_pressure.push_back(r);
    if (!set.runs[r].has(models::quantities::kLoad)) continue;
    const std::vector<double>& load_N = set.runs[r].column(models::quantities::kLoad);
    const double load = *std::max_element(load_N.begin(), load_N.end()) / reference.reference_load_N;
    if (load > kOddLoad || (load < 1.0 / kOddLoad && load > measurements::kLoadedShare)) odd_load.push_back(r);
  }
  const auto warn = [&](const std::vector<std::size_t>& runs, const char* what, double reference_value,
                        const char* unit) {
    if (runs.empty()) return;
    warnings.push_back(
        fmt::format("{} of {} is far from {:.0f} {} at which tire {} was identified: is it its "
                    "file?",
                    what, name_runs(set, runs), reference_value, unit, set.tire.name));
  };
  warn(odd_pressure, "the cold pressure", reference.reference_pressure_Pa / 1e3, "kPa");
  warn(odd_load, "the load", reference.reference_load_N, "N");
  return warnings;
}

std::vector<std::string> check_tire(const MeasurementSet& set, const BaselineRuns& baseline, int threads) {
  std::vector<std::string> warnings;
  if (set.rig.has_value() && set.baseline == models::Baseline::kCombined) {
    const auto warning = set.tire.warn_of_conductances(set.rig->cooling_rig());
    if (warning.has_value()) warnings.push_back(*warning);
  }
  for (std::string& warning : check_tire_conditions(set)) warnings.push_back(std::move(warning));
  check_level(set, baseline, warnings);
  check_other_tires(set, baseline, threads, warnings);
  return warnings;
}

}  // namespace rollrig::diagnosis
