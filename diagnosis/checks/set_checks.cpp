#include "diagnosis/checks/set_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/checks/mistakes.h"
#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/sample_checks.h"
#include "diagnosis/checks/still_inputs.h"
#include "diagnosis/checks/tire_checks.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/run_rows.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kOutside = 2.0;  // tolerances of plausibility.h; effects of unlikely size stay below

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
                       const std::vector<FoundMistake>& mistakes) {
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    if (misfits[r].failure.empty()) continue;
    throw InputError({fmt::format("run '{}' cannot be simulated: {}", set.runs[r].id, misfits[r].failure),
                      set.runs[r].file, 0, "", "",
                      mistakes.empty() ? "inputs that such a test can have" : describe(set, mistakes.front()), ""});
  }
}

/// Names what cannot be true in some runs.
void report_suspicion(const std::string& suspicion, const std::vector<std::size_t>& runs, SetChecks& checks) {
  checks.suspicion += (checks.suspicion.empty() ? "" : "; ") + suspicion;
  checks.doubt = checks.suspicion + ": no cause is named until that is corrected";
  checks.mistaken_runs.insert(checks.mistaken_runs.end(), runs.begin(), runs.end());
  std::sort(checks.mistaken_runs.begin(), checks.mistaken_runs.end());
  const auto end = std::unique(checks.mistaken_runs.begin(), checks.mistaken_runs.end());
  checks.mistaken_runs.erase(end, checks.mistaken_runs.end());
}

void report_mistakes(const MeasurementSet& set, const std::vector<FoundMistake>& mistakes, SetChecks& checks) {
  for (const FoundMistake& mistake : mistakes) report_suspicion(describe(set, mistake), mistake.runs, checks);
}

/// Inputs that stand still although they should move.
void report_still(const std::vector<StillInput>& still, SetChecks& checks) {
  for (const StillInput& one : still) {
    if (one.is_certain) {
      report_suspicion(one.text + ": a stuck sensor, or a number that stands for none", one.runs, checks);
    } else {
      checks.warnings.push_back(one.text +
                                ": measured, or a number that stands for none? What follows it cannot be told then");
    }
  }
}

/// Whether no sensor of the mistaken runs stands still once the mistakes are undone.
bool moves_without(const std::vector<FoundMistake>& mistakes, MeasurementSet set, int threads) {
  std::vector<std::size_t> runs;
  for (const FoundMistake& one : mistakes) {
    for (const std::size_t r : one.runs) one.mistake.undo(set.runs[r]);
    runs.insert(runs.end(), one.runs.begin(), one.runs.end());
  }
  const Stuck left = find_stuck(set, resimulate_baseline(set, threads));
  return std::none_of(left.rows.begin(), left.rows.end(), [&runs](const DoubtfulRows& rows) {
    return std::find(runs.begin(), runs.end(), rows.run) != runs.end();
  });
}

/// A column that stands still where it should not: another's under its heading, or a stuck sensor.
void check_stuck(const MeasurementSet& set, const BaselineRuns& baseline, int threads, SetChecks& checks) {
  const Stuck stuck = find_stuck(set, baseline);
  if (stuck.rows.empty()) return;
  // Where a column stands still, a factor may fit it by chance.
  const auto tells = [&stuck](const Mistake& mistake, std::size_t r) {
    return mistake.is_exchange &&
           std::any_of(stuck.rows.begin(), stuck.rows.end(), [r](const DoubtfulRows& rows) { return rows.run == r; });
  };
  const std::vector<FoundMistake> exchanges = find_mistakes(set, baseline, threads, tells);
  if (!exchanges.empty() && moves_without(exchanges, set, threads)) {
    report_mistakes(set, exchanges, checks);
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

/// Inputs that stand still once mistakes are undone: a column that moves in one run, since it is another's there, says
/// nothing of the other runs.
std::vector<StillInput> find_still_without(const std::vector<FoundMistake>& mistakes, MeasurementSet set) {
  for (const FoundMistake& one : mistakes) {
    for (const std::size_t r : one.runs) one.mistake.undo(set.runs[r]);
  }
  return find_still_inputs(set);
}

/// Inputs that stand still, columns and units. A column that stands still tells nothing of its unit.
void check_plausibility(const MeasurementSet& kept, const BaselineRuns& baseline, int threads, SetChecks& checks) {
  const std::vector<StillInput> still = find_still_inputs(kept);
  const auto tells = [&still](const Mistake& mistake, std::size_t r) {
    return std::none_of(still.begin(), still.end(), [&](const StillInput& one) {
      const auto& columns = mistake.columns;
      return std::find(one.runs.begin(), one.runs.end(), r) != one.runs.end() &&
             std::find(columns.begin(), columns.end(), one.column) != columns.end();
    });
  };
  const std::vector<FoundMistake> mistakes = find_mistakes(kept, baseline, threads, tells);
  report_still(mistakes.empty() ? still : find_still_without(mistakes, kept), checks);
  require_simulated(kept, baseline.misfits, mistakes);
  report_mistakes(kept, mistakes, checks);
  std::vector<std::size_t> others;
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    if (std::count(checks.mistaken_runs.begin(), checks.mistaken_runs.end(), r) == 0) others.push_back(r);
  }
  const std::string outside = describe_misfit(kept, others, baseline.misfits);
  if (outside.empty()) return;
  const std::string suspicion = fmt::format(
      "further from the simulation than any effect of the catalog: {}. Check tire, rig, columns and units", outside);
  if (!checks.suspicion.empty()) {
    checks.warnings.push_back(suspicion);
    return;
  }
  checks.suspicion = suspicion;
  checks.doubt = suspicion + "; no cause is named";
}

/// The doubt as the last of the warnings.
SetChecks warn_of_doubt(SetChecks checks) {
  checks.warnings.push_back(checks.doubt);
  return checks;
}

}  // namespace

SetChecks check_set(const MeasurementSet& set, int threads, const Progress& progress) {
  // Assumed: shares of the time, as measured with sets of 40 runs of 10 h.
  constexpr double kSimulated = 0.15, kStuckFound = 0.25, kPlausible = 0.75;
  const auto report = [&progress](double share, const char* stage) {
    if (progress) progress(share, stage);
  };
  measurements::make_context(set);  // throws where the files lack what the kind needs
  for (const auto& [channel, sensor] : set.sensors) require_noise(set, channel);
  SetChecks checks;
  checks.warnings = measurements::describe_bad_rows(set);
  check_assumed(set, checks);
  check_samples(set, checks);
  report(0.0, "simulating the runs");
  BaselineRuns baseline = resimulate_baseline(set, threads);
  report(kSimulated, "looking for stuck sensors");
  check_stuck(set, baseline, threads, checks);
  if (checks.is_implausible()) return warn_of_doubt(std::move(checks));
  const MeasurementSet kept = leave_out(set, checks.left_out);
  for (std::size_t r = 0; r < kept.runs.size(); ++r) {
    const bool simulated = baseline.misfits[r].failure.empty();
    if (simulated) baseline.misfits[r] = calc_misfit(kept, kept.runs[r], baseline.recordings[r]);
  }
  require_rest(kept, checks);
  report(kStuckFound, "checking columns and units");
  check_plausibility(kept, baseline, threads, checks);
  if (checks.is_implausible()) {
    const std::vector<std::string> of_conditions = check_tire_conditions(kept);
    checks.warnings.insert(checks.warnings.end(), of_conditions.begin(), of_conditions.end());
    return warn_of_doubt(std::move(checks));
  }
  report(kPlausible, "checking the tire");
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
