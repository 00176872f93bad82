#pragma once
/// Diagnoses the cases of a validation set, one answer file a case. The tasks of known causes alone need the truth.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "campaigns/part.h"
#include "validation/scoring/answer.h"
#include "validation/scoring/answered_items.h"

namespace rollrig::validation {

struct Truth;

/// A case to be diagnosed, and with which effects in the comparison.
struct Task {
  std::string number;
  std::vector<std::string> only;
  std::vector<std::string> without;
};

/// What answers a case. Throws what diagnosis::diagnose() throws.
using AnswerBy = std::function<diagnosis::Diagnosis(const measurements::MeasurementSet& set, const Settings& settings)>;

/// The diagnosis, on one thread.
diagnosis::Diagnosis answer_by_diagnosis(const measurements::MeasurementSet& set, const Settings& settings);

struct RunOrder {
  std::string set;
  std::string out;            // folder of the answers
  std::vector<Task> tasks;    // the same in each process
  int threads = 0;            // cases at the same time; 0: as many as the machine has
  campaigns::Part part = {};  // the tasks of this process
  std::function<void(std::size_t done, std::size_t of)> progress = {};
  AnswerBy answer_by = answer_by_diagnosis;
};

/// A task for each case, all with the same comparison. Reads nothing but the names of the cases.
std::vector<Task> plan_tasks(const std::string& set, const std::vector<std::string>& only,
                             const std::vector<std::string>& without);

// Fits that know the cause, made once the truth is open: what can be achieved, and what happens without the truth.
enum class KnownCause {
  kAlone,    // the true effects alone: how far the gap can shrink
  kLeftOut,  // without the true effects and their twins: whether a neighbor is named instead
};

/// Effects by case.
using Twins = std::map<std::string, std::vector<std::string>>;

/// What a case's own data do not tell from the truth: the others of the set that its answer names, where the truth is
/// in that, of whatever size.
Twins find_twins(const std::vector<Truth>& truths, const std::string& answers);

/// Adds to the twins of each case all effects that the catalog calls confusable with the true ones, either way.
void add_confusable(const std::vector<Truth>& truths, Twins& twins);

/// A task for each case with effects of the catalog. `only` as in plan_tasks(); `twins` are left out with the truth.
std::vector<Task> plan_known_cause(const std::vector<Truth>& truths, KnownCause cause,
                                   const std::vector<std::string>& only, const Twins& twins = {});

/// Diagnoses what has no answer yet by this program, with this comparison, of these files; see carry_out_answers().
/// Opens nothing but the cases.
/// Checked  tests/validation/scoring/run_cases_test.cpp
AnswerTally run_cases(const RunOrder& order);

}  // namespace rollrig::validation
