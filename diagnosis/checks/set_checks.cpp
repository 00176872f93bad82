#include "diagnosis/checks/set_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/repairs.h"
#include "diagnosis/checks/sample_checks.h"
#include "diagnosis/checks/tire_checks.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/run_rows.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kOdd = 0.3;      // tolerances of plausibility.h from which a mistake is looked for
constexpr double kOutside = 2.0;  // from which none is needed to doubt the set; effects of unlikely size stay below

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// Warns of numbers that the files do not give.
void check_assumed(const MeasurementSet& set, SetChecks& checks) {
  if (!set.assumed_sensors.empty()) {
    checks.warnings.push_back(fmt::format("the set describes no sensor of {}: the noise of a usual one is assumed",
                                          join(list_headers(set.assumed_sensors))));
  }
  if (!set.tire.has_thermal || !set.tire.has_rolling_resistance) {
    checks.warnings.push_back(fmt::format(
        "tire {} has no [rolling_resistance] or no [thermal]: effects that need them take values of its class",
        set.tire.name));
  }
}

/// Channels that lie outside all that an effect can make, and their levels.
std::string describe_misfit(const MeasurementSet& set, const std::vector<std::size_t>& runs,
                            const std::vector<RunMisfit>& misfits) {
  std::vector<std::string> parts;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    std::vector<std::size_t> outside;
    double ratio = 1.0;
    for (const std::size_t r : runs) {
      for (const ChannelMisfit& at : misfits[r].channels) {
        if (at.channel != channel || at.rms <= kOutside) continue;
        ratio = outside.empty() ? at.ratio : ratio;
        outside.push_back(r);
      }
    }
    if (outside.empty()) continue;
    parts.push_back(fmt::format("{} of {} ({:.2g} of the simulated, on average)", channel.header(),
                                name_runs(set, outside), ratio));
  }
  return join(parts);
}

/// Throws for the first run that cannot be simulated, with the mistake that would explain it.
void require_simulated(const MeasurementSet& set, const std::vector<RunMisfit>& misfits,
                       const std::optional<Repair>& repair) {
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (misfits[r].failure.empty()) continue;
    throw InputError({fmt::format("run '{}' cannot be simulated: {}", set.runs[r].id, misfits[r].failure),
                      set.runs[r].file, 0, "", "",
                      repair.has_value() ? "it looks as if " + repair->text : "inputs that such a test can have", ""});
  }
}

void report_repair(const MeasurementSet& set, const Repair& repair, SetChecks& checks) {
  checks.suspicion = fmt::format("in {} it looks as if {}", name_runs(set, repair.runs), repair.text);
  checks.doubt = checks.suspicion + ": no cause is named until that is mended";
  checks.warnings.push_back(checks.doubt);
}

/// Whether no sensor of these runs stands still once the mistake is undone.
bool moves_without(const Repair& repair, MeasurementSet set, const std::vector<std::size_t>& runs, int threads) {
  for (const std::size_t r : runs) repair.undo(set.runs[r]);
  const Stuck left = find_stuck(set, resimulate_baseline(set, threads));
  return std::none_of(left.rows.begin(), left.rows.end(), [&runs](const DoubtfulRows& rows) {
    return std::find(runs.begin(), runs.end(), rows.run) != runs.end();
  });
}

/// A column that stands still where it should not: another's under its heading, or a stuck sensor.
void check_stuck(const MeasurementSet& set, const BaselineRuns& baseline, int threads, SetChecks& checks) {
  const Stuck stuck = find_stuck(set, baseline);
  if (stuck.rows.empty()) return;
  std::vector<std::size_t> runs;
  for (const DoubtfulRows& rows : stuck.rows) {
    if (runs.empty() || runs.back() != rows.run) runs.push_back(rows.run);
  }
  const std::optional<Repair> repair = find_repair(set, runs, Mistakes::kExchanges, threads);
  if (repair.has_value() && moves_without(*repair, set, runs, threads)) {
    report_repair(set, *repair, checks);
    return;
  }
  checks.left_out.insert(checks.left_out.end(), stuck.rows.begin(), stuck.rows.end());
  checks.warnings.insert(checks.warnings.end(), stuck.warnings.begin(), stuck.warnings.end());
}

/// Where all sensors stand still nothing is left to diagnose.
void require_rest(const MeasurementSet& kept, const SetChecks& checks) {
  const std::vector<Quantity> channels = measurements::measured_channels(*kept.kind);
  for (const MeasuredRun& run : kept.runs) {
    const auto is_left = [&](const Quantity& channel) { return !find_compared_rows(kept, run, channel).empty(); };
    if (checks.left_out.empty() || std::any_of(channels.begin(), channels.end(), is_left)) return;
  }
  const DoubtfulRows& first = checks.left_out.front();
  throw InputError({"every measured channel stands still where it should move: stuck sensors, or no measurement at all",
                    kept.runs[first.run].file, 0, first.channel.header(), "", "samples of a sensor that works", ""});
}

/// Columns and units.
void check_plausibility(const MeasurementSet& kept, const BaselineRuns& baseline, int threads, SetChecks& checks) {
  const std::vector<RunMisfit>& misfits = baseline.misfits;
  std::vector<std::size_t> odd;
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    if (misfits[r].worst() > kOdd) odd.push_back(r);
  }
  if (odd.empty()) return;
  const std::optional<Repair> repair = find_repair(kept, odd, Mistakes::kAll, threads);
  require_simulated(kept, misfits, repair);
  if (repair.has_value()) {
    report_repair(kept, *repair, checks);
    return;
  }
  const std::string outside = describe_misfit(kept, odd, misfits);
  if (outside.empty()) return;
  checks.suspicion = fmt::format(
      "further from the simulation than any effect of the catalog: {}. Check tire, rig, columns and units", outside);
  checks.doubt = checks.suspicion + "; no cause is named";
  checks.warnings.push_back(checks.doubt);
}

}  // namespace

SetChecks check_set(const MeasurementSet& set, int threads) {
  measurements::make_context(set);  // throws where the files lack what the kind needs
  for (const auto& [channel, sensor] : set.sensors) require_noise(set, channel);
  SetChecks checks;
  checks.warnings = measurements::describe_bad_rows(set);
  check_assumed(set, checks);
  check_samples(set, checks);
  BaselineRuns baseline = resimulate_baseline(set, threads);
  check_stuck(set, baseline, threads, checks);
  if (checks.is_implausible()) return checks;
  const MeasurementSet kept = leave_out(set, checks.left_out);
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    const bool simulated = baseline.misfits[r].failure.empty();
    if (simulated) baseline.misfits[r] = calc_misfit(kept, kept.runs[r], baseline.recordings[r]);
  }
  require_rest(kept, checks);
  check_plausibility(kept, baseline, threads, checks);
  if (checks.is_implausible()) return checks;
  const std::vector<std::string> of_tire = check_tire(kept, baseline, threads);
  checks.warnings.insert(checks.warnings.end(), of_tire.begin(), of_tire.end());
  return checks;
}

MeasurementSet leave_out(MeasurementSet set, const std::vector<DoubtfulRows>& rows) {
  for (const DoubtfulRows& at : rows) {
    std::vector<double>& values = set.runs[at.run].column(at.channel);
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(at.first_row),
              values.begin() + static_cast<std::ptrdiff_t>(at.last_row) + 1, std::nan(""));
  }
  return set;
}

}  // namespace rollrig::diagnosis
