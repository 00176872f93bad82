#include "diagnosis/pair/machine_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "diagnosis/checks/set_checks.h"
#include "diagnosis/findings/gap.h"
#include "diagnosis/findings/locations.h"
#include "diagnosis/pair/find_difference.h"
#include "diagnosis/pair/rrc_difference.h"
#include "diagnosis/terms/machine_terms.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasurementSet;
using rollrig::PairFindings;
using rollrig::PairVerdict;

constexpr const char* kAgainst = "--against";

/// Names that differ only in what a person calls them are the same file.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code code;
  return a == b || std::filesystem::equivalent(a, b, code);
}

void require_two_machines(const MeasurementSet& a, const MeasurementSet& b) {
  if (is_same_file(a.path, b.path)) {
    throw InputError({"a set is compared with itself", b.path, 0, kAgainst, "", "the set of another machine", ""});
  }
  for (const MeasurementSet* set : {&a, &b}) {
    if (set->rig.has_value()) continue;
    throw InputError({"two machines are compared, and this set was measured on the road", set->path, 0, "kind",
                      set->kind->word, "sets of the same kind of rig", ""});
  }
  if (a.kind != b.kind) {
    throw InputError({fmt::format("the machines are of different kinds: '{}' and '{}'", a.kind->word, b.kind->word),
                      b.path, 0, kAgainst, b.kind->word, fmt::format("a set of kind '{}'", a.kind->word), ""});
  }
  if (a.baseline != b.baseline) {
    throw InputError({"the sets are judged against different laws of the tire", b.path, 0, "baseline", "",
                      "the same baseline in both sets", ""});
  }
}

/// Numbers that a rig may change: conductances of a tire there.
bool is_of_rig(const std::string& key) {
  return key == "tire.thermal.z_W_per_K" || key == "tire.thermal.f_W_s_per_m_K";
}

/// Throws InputError where the tire files differ in a number or its uncertainty.
void require_one_tire(const MeasurementSet& a, const MeasurementSet& b) {
  const auto refuse = [&](const std::string& what, const std::string& value, const std::string& allowed) {
    throw InputError({"the sets are of different tires: " + what, b.path, 0, "tire", value, allowed, ""});
  };
  if (a.tire.name != b.tire.name) {
    refuse(fmt::format("'{}' and '{}'", a.tire.name, b.tire.name), b.tire.name,
           "the same tire file in both sets: the comparison rests on it");
  }
  const models::Context<double> first = measurements::make_context(a);
  models::Context<double> second = measurements::make_context(b);
  models::Context<double> of_first = first;
  estimation::visit_parameters(of_first, [&](const std::string& table, const Field& field, double& value) {
    const std::string key = table + "." + field.output_key();
    if (table.rfind("tire.", 0) != 0 || is_of_rig(key)) return;
    const double other = estimation::find_parameter(second, key);
    if (value == other || (std::isnan(value) && std::isnan(other))) return;
    const Unit unit = unit_of_key(field.key);
    refuse(fmt::format("their files give {} = {:.6g} and {:.6g}", estimation::find_file_key(key), unit.from_si(value),
                       unit.from_si(other)),
           b.tire.name, "the same tire file in both sets: the comparison rests on it");
  });
}

/// How many of the rows with a force have that of the row before.
double find_still_share(const std::vector<double>& force) {
  double rows = 0.0, still = 0.0;
  for (std::size_t i = 1; i < force.size(); ++i) {
    if (std::isnan(force[i])) continue;
    rows += 1.0;
    still += force[i] == force[i - 1] ? 1.0 : 0.0;
  }
  return rows > 0.0 ? still / rows : 1.0;
}

/// A column of a run, and the times of its rows.
struct TimedColumn {
  const std::vector<double>& time_s;
  const std::vector<double>& values;

  double count() const {
    return static_cast<double>(
        std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  }
};

/// How many rows of both are equal to the digit, with the second one's times later by a shift.
double count_equal_rows(const TimedColumn& a, const TimedColumn& b, double shift_s) {
  constexpr double kSameTime_s = 1e-6;
  double equal = 0.0;
  for (std::size_t i = 0, k = 0; i < a.values.size() && k < b.values.size();) {
    const double later_s = b.time_s[k] - shift_s - a.time_s[i];
    const bool is_one_time = std::abs(later_s) <= kSameTime_s;
    if (is_one_time && a.values[i] == b.values[k]) equal += 1.0;
    if (is_one_time || later_s > 0.0) ++i;
    if (is_one_time || later_s < 0.0) ++k;
  }
  return equal;
}

/// The shift by which most stretches of four different readings of the second are among the first 1000 of the first
/// column; 0 where there are none.
double find_time_shift_s(const TimedColumn& a, const TimedColumn& b) {
  constexpr std::size_t kStretch = 4;
  using Stretch = std::array<double, kStretch>;
  const auto read_stretch = [](const TimedColumn& of, std::size_t at) -> std::optional<Stretch> {
    Stretch stretch{};
    for (std::size_t i = 0; i < kStretch; ++i) {
      stretch[i] = of.values[at + i];
      if (std::isnan(stretch[i]) || (i > 0 && stretch[i] == stretch[i - 1])) return std::nullopt;
    }
    return stretch;
  };
  std::map<Stretch, double> times_s;
  constexpr std::size_t kMostStretches = 1000;
  for (std::size_t i = 0; i + kStretch <= a.values.size() && times_s.size() < kMostStretches; ++i) {
    if (const auto stretch = read_stretch(a, i)) times_s.emplace(*stretch, a.time_s[i]);
  }
  constexpr double kSteps_per_s = 1e4;  // finer than clocks of recordings
  std::map<long, std::size_t> counts;
  for (std::size_t i = 0; i + kStretch <= b.values.size(); ++i) {
    const auto stretch = read_stretch(b, i);
    const auto found = stretch.has_value() ? times_s.find(*stretch) : times_s.end();
    if (found != times_s.end()) ++counts[std::lround(kSteps_per_s * (b.time_s[i] - found->second))];
  }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& x, const auto& y) { return x.second < y.second; });
  return most == counts.end() ? 0.0 : static_cast<double>(most->first) / kSteps_per_s;
}

/// Whether most rows of the shorter column are, at the same time or later by a constant, rows of the other: rows may
/// have been left out or changed. Coarse readings are equal by chance, about as often as those of successive rows of
/// one run.
bool is_same_column(const TimedColumn& a, const TimedColumn& b, double most_still) {
  constexpr double kMost = 0.5;  // Assumed: of the rows
  const double rows = std::min(a.count(), b.count());
  const double by_chance = std::max(find_still_share(a.values), find_still_share(b.values));
  if (!(rows > 0.0) || by_chance > most_still) return false;
  const double equal = std::max(count_equal_rows(a, b, 0.0), count_equal_rows(a, b, find_time_shift_s(a, b)));
  return equal == rows || equal / rows > std::max(kMost, 0.5 * (1.0 + by_chance));
}

/// Whether a channel of one run is a copy of that of the other. Of the two channels of the tire, one that hardly
/// changes says nothing: both machines may hold it at one value.
bool is_same_recording(const measurements::MeasuredRun& a, const measurements::MeasuredRun& b, const Quantity& force) {
  constexpr double kMostStill = 0.9;  // Assumed: of rows that are equal to the one before
  const auto is_same = [&](const Quantity& channel, double most_still) {
    if (!a.has(channel) || !b.has(channel)) return false;
    return is_same_column({a.time_s, a.column(channel)}, {b.time_s, b.column(channel)}, most_still);
  };
  return is_same(force, 1.0) || is_same(models::quantities::kLinerTemperature, kMostStill) ||
         is_same(models::quantities::kCavityPressure, kMostStill);
}

void require_own_recordings(const MeasurementSet& a, const MeasurementSet& b) {
  for (const measurements::MeasuredRun& one : a.runs) {
    for (const measurements::MeasuredRun& other : b.runs) {
      if (!is_same_recording(one, other, a.kind->traits.force)) continue;
      throw InputError({"both sets hold the same recording, so it is not of two machines", other.file, 0, "run",
                        other.id, "runs that each machine measured itself", ""});
    }
  }
}

/// A unit in which a force or torque may have been recorded instead of that of its column.
struct OtherForceUnit {
  const char* name;
  double SI = 1.0;
};

/// Why the force of one machine may be in another unit; empty where it is not likely. Machines that test one tire
/// differ by less than 20 %, and all of these units by more. Load has such a check in each set by itself
/// (list_wrong_units()).
/// Source  NIST SP 811 for the units. Assumed: 4 % about a unit's factor, by which machines may differ besides
std::string doubt_force_unit(const measurements::MeasurementSet& a, double ratio) {
  constexpr double kNear = 0.04;
  constexpr double kFoot_m = 0.3048;
  const Quantity& force = a.kind->traits.force;
  const bool is_torque = force.unit_suffix() == "Nm";
  const std::vector<OtherForceUnit> units =
      is_torque ? std::vector<OtherForceUnit>{{"lbf ft", kPoundForce_N * kFoot_m}, {"kgf m", kStandardGravity_m_s2}}
                : std::vector<OtherForceUnit>{{"lbf", kPoundForce_N}, {"kgf", kStandardGravity_m_s2}};
  for (const OtherForceUnit& unit : units) {
    for (const std::size_t machine : {0U, 1U}) {
      const double expected = machine == 0 ? unit.SI : 1.0 / unit.SI;
      if (!(std::abs(std::log(ratio / expected)) <= kNear)) continue;
      return fmt::format(
          "{}: {} seems to be in {} and not in {}: RRc on B is {:.3f} times that on A, and one {} is {:.4g} {}; no "
          "cause is named until that is corrected",
          letter_of_machine(machine), force.header(), unit.name, force.unit_suffix(), ratio, unit.name, unit.SI,
          force.unit_suffix());
    }
  }
  return "";
}

/// Throws InputError for an effect in which machines cannot differ.
void require_known(const rollrig::DiagnosisOptions& options) {
  std::vector<std::string> known = term_names();
  for (const models::Effect* effect : effects_between_machines()) known.push_back(effect->info.id);
  for (const auto& [option, list] : {std::pair("--only", &options.only), std::pair("--without", &options.without)}) {
    for (const std::string& name : *list) {
      if (std::count(known.begin(), known.end(), name) > 0) continue;
      InputProblem problem = unknown_name("effect", name, known);
      problem.file = "command line";
      problem.key = option;
      throw InputError(problem);
    }
  }
}

MeasurementSet name_runs(MeasurementSet set, std::size_t machine) {
  for (measurements::MeasuredRun& run : set.runs) run.id = fmt::format("{}: {}", letter_of_machine(machine), run.id);
  return set;
}

/// The set without what its checks leave out; what they say goes into the findings.
MeasurementSet check_machine(const MeasurementSet& set, std::size_t machine, int threads, PairFindings& findings) {
  const SetChecks checks = check_set(set, threads);
  for (const std::string& warning : checks.warnings) {
    findings.warnings.push_back(fmt::format("{}: {}", letter_of_machine(machine), warning));
  }
  if (checks.is_implausible()) findings.doubt = fmt::format("{}: {}", letter_of_machine(machine), checks.doubt);
  return name_runs(leave_out(set, checks.left_out), machine);
}

/// What acts on both machines, then what acts on one.
std::vector<const Term*> choose_pair_terms(const MeasurementSet& set, const rollrig::DiagnosisOptions& options) {
  const models::TireModel& tire = set.tire.model(set.baseline);
  std::vector<const Term*> terms = choose_terms(set.kind->traits, tire, options.only, options.without);
  for (const Term* term : choose_machine_terms(set.kind->traits, tire, options.only, options.without)) {
    terms.push_back(term);
  }
  return terms;
}

/// curvature_exponent is too faint on one drum; on two it is not.
void add_curvature(const Study& study, const rollrig::DiagnosisOptions& options, std::vector<const Term*>& terms) {
  const Term* curvature = look_up_term("curvature_exponent");
  const bool is_wanted =
      std::count(options.without.begin(), options.without.end(), curvature->name()) == 0 &&
      (options.only.empty() || std::count(options.only.begin(), options.only.end(), curvature->name()) > 0);
  const bool is_there = std::count(terms.begin(), terms.end(), curvature) > 0;
  if (is_wanted && !is_there && !list_differing(study, {curvature->name()}).empty()) terms.push_back(curvature);
}

/// The first cause on runs that its fit did not see: an objection leaves it the part that it leaves a cause of one set.
void weigh_on_left_out_runs(const Study& study, const NamedDifference& first, PairFindings& findings) {
  const Gap gap = find_gap(study, first.lead);
  findings.left_out_nats = gap.left_out_nats;
  double kept = 1.0;
  if (gap.left_out_nats.has_value() && !(*gap.left_out_nats >= thresholds::kConfirmed_nats)) {
    kept = thresholds::kKeptHardlyLikelier;
    findings.warnings.push_back("runs left out are hardly likelier with the first cause");
  }
  rollrig::MachineDifference& cause = findings.causes.front();
  const double moved = (1.0 - kept) * cause.probability;
  cause.probability *= kept;
  for (rollrig::OnMachine& on : cause.on_machine) {
    for (double& one : on.probability) one *= kept;
    findings.probability[on.effect] *= kept;
  }
  findings.probability["unknown"] += moved;
}

}  // namespace

PairFindings diagnose_pair(const MeasurementSet& a, const MeasurementSet& b, const rollrig::DiagnosisOptions& options) {
  require_known(options);
  require_two_machines(a, b);
  require_one_tire(a, b);
  require_own_recordings(a, b);
  PairFindings findings;
  findings.sets = {a.name, b.name};
  findings.machines = {a.rig->name, b.rig->name};
  findings.tire = a.tire.name;
  StudySettings settings;
  Stages& stages = *settings.stages;
  stages.report = options.progress;
  stages.begin("checks", 0.015);
  const std::vector<MeasurementSet> sets{check_machine(a, 0, options.threads, findings),
                                         check_machine(b, 1, options.threads, findings)};
  settings.terms = choose_pair_terms(sets.front(), options);
  settings.threads = options.threads;
  // The tire's numbers are common, so that wide priors cost little; narrow ones could be wrong.
  if (is_tire_origin_open(a) || is_tire_origin_open(b)) settings.belief = TireBelief::kClass;
  Study study(sets, settings);
  add_curvature(study, options, study.settings.terms);
  const Comparison comparison = compare_models(study);
  findings.probability = find_pair_probabilities(study, comparison);
  const std::vector<NamedDifference> differences = find_differences(study, comparison);
  for (const NamedDifference& one : differences) findings.causes.push_back(one.cause);
  findings.verdict = find_pair_verdict(findings.probability, differences);
  findings.difference = read_rrc_difference(study.set, study.null.fit.simulated);
  stages.begin("where", 0.8);
  findings.where = find_locations(study);
  stages.begin("runs left out", 1.0);
  if (findings.verdict != PairVerdict::kAgree && !differences.empty()) {
    findings.remaining = read_rrc_difference(study.set, differences.front().lead->fit.simulated);
    weigh_on_left_out_runs(study, differences.front(), findings);
    if (findings.probability["unknown"] >= findings.causes.front().probability) {
      findings.verdict = PairVerdict::kUnexplained;
    }
  }
  if (findings.doubt.empty()) {
    findings.doubt = doubt_force_unit(a, read_rrc_ratio(study.set, study.null.fit.simulated));
    if (!findings.doubt.empty()) findings.warnings.push_back(findings.doubt);
  }
  if (!findings.doubt.empty()) {
    findings.verdict = PairVerdict::kUnexplained;
    findings.causes.clear();
    findings.remaining.reset();
  }
  return findings;
}

}  // namespace rollrig::diagnosis
