#pragma once
/// Several measurement sets at once: one table, and which effects come back from set to set.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

/// What sets share.
enum class Shared { kMachine, kTire, kMachineAndTire };

/// An effect over all sets that share a machine, a tire, or both.
struct Recurrence {
  std::string effect;
  Shared shared = Shared::kMachine;
  std::string name;                 // of what is shared
  std::size_t sets = 0;             // that share it
  std::size_t named_in = 0;         // of these
  double probability = 0.0;         // that it acts in all of them
  std::optional<double> mean_size;  // weighted by the sets' uncertainties, in `unit`; none where named in no set
  double mean_size_sd = 0.0;
  std::string unit;
  std::optional<double> same_size_p;  // chance of sizes that differ this much if they are one; none below two sizes
};

/// Probability that an effect acts in all sets of a group, rather than in each by itself or not.
/// Equation  log odds = log(q/(1-q)) + sum over sets of log(b/(q b + 1 - q)), b = P/(1-P) (1-q)/q
/// Symbols   q prior probability of the effect, P its probability in a set; b Bayes factor of the set for it
/// Validity  sets with sessions of their own. Of one set P/(P + 1 - q), a half at most: one set cannot show that
///           an effect comes back
/// Checked   tests/diagnosis/fleet_test.cpp
double calc_recurrence_probability(const std::vector<double>& in_sets, double prior);

/// Which effects come back with the machine or with the tire. An effect is listed where it is named in one set at
/// least and acts with more than 80 % in all that share something, two sets at least: the widest such group of each
/// effect, the likeliest first. A set whose files are in doubt says nothing of any effect.
/// Source  Assumed: q = 0.02, about what a single effect has in a comparison of the whole catalog; 80 %, since what is
///         named once and not excluded elsewhere says little
std::vector<Recurrence> find_recurrences(const std::vector<FleetMember>& members);

struct Fleet {
  std::vector<FleetMember> members;
  std::vector<Recurrence> recurrences;
  std::vector<Json> documents = {};  // as many as members, their diagnoses as a campaign has stored them; else none
};

/// The machine of a set: its rig or, on the road, its vehicle.
std::string machine_of(const measurements::MeasurementSet& set);

/// The diagnosis of one set as a campaign stores it: `machine`, `tire`, `doubt`, `diagnosis` (rollrig-diagnosis/1).
/// Errors  InputError: the set cannot be read or diagnosed. RunFailure
Json diagnose_member(const std::string& folder, const DiagnosisOptions& options, BadRows bad_rows);

/// Adds the set to which such a result belongs. Throws InputError where it is none.
void add_member(const std::string& folder, const Json& result, Fleet& fleet);
/// Adds a set that could not be diagnosed.
void add_failed_member(const std::string& folder, const std::string& failure, Fleet& fleet);

/// A row a set: verdict, cause, gap before and after.
Table make_fleet_table(const Fleet& fleet);

/// This table, then what failed, what is in doubt, and what comes back; 80 columns but for places in files.
std::string format_fleet(const Fleet& fleet);

/// rollrig-fleet/1: `sets` (each `folder`, `machine`, `tire`, `failure`, `diagnosis` as of one set), `recurring`.
Json make_fleet_json(const Fleet& fleet);

}  // namespace rollrig::diagnosis
