#include "validation/scoring/run_cases.h"

#include <ctime>

#include <chrono>
#include <filesystem>
#include <optional>

#include "measurements/measurement_set.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "validation/files.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

double thread_cpu_s() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void make_folder(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder)) {
    throw InputError({"cannot make the folder '" + folder + "'", folder, 0, "--out", folder,
                      "a folder where this user may write", ""});
  }
  require_writable(answer_file(folder, "any"));
}

/// The diagnosis of a case, or why there is none. Throws Interrupted.
void diagnose(const std::string& folder, const AnswerBy& answer_by, Answer& answer) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start_s = thread_cpu_s();
  try {
    answer.diagnosis = answer_by(measurements::read_measurement_set(folder), answer.settings);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    answer.failure = error.what();
  }
  answer.cpu_seconds = thread_cpu_s() - cpu_start_s;
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Cases to be diagnosed; the result of an item is its answer.
class AnswerItems : public AnsweredItems {
 public:
  explicit AnswerItems(const RunOrder& order) : order_(order) {
    const std::string program = hash_program();
    for (std::size_t i = 0; i < order.tasks.size(); ++i) {
      if (!order.part.has(i)) continue;
      const Task& task = order.tasks[i];
      Answer& open = open_.emplace_back();
      open.number = task.number;
      open.set_sha256 = hash_case(case_folder(order.set, task.number));
      open.settings = {program, task.only, task.without};
    }
  }

  std::size_t count() const override { return open_.size(); }
  Json describe(std::size_t item) const override {
    const Answer& open = open_[item];
    return {{"case", open.number},
            {"set_sha256", open.set_sha256},
            {"only", open.settings.only},
            {"without", open.settings.without}};
  }
  Json carry_out(std::size_t item, std::uint64_t) const override {
    Answer answer = open_[item];
    diagnose(case_folder(order_.set, answer.number), order_.answer_by, answer);
    return make_answer_json(answer);
  }
  std::string number_of(std::size_t item) const override { return open_[item].number; }
  std::optional<Json> find_before(std::size_t item) const override {
    const Answer& open = open_[item];
    const std::optional<Answer> before = find_answer(order_.out, open.number);
    if (!before || before->set_sha256 != open.set_sha256 || !(before->settings == open.settings)) return std::nullopt;
    return Json{{"failure", before->failure}};
  }

 private:
  const RunOrder& order_;
  std::vector<Answer> open_;  // without their diagnoses
};

}  // namespace

diagnosis::Diagnosis answer_by_diagnosis(const measurements::MeasurementSet& set, const Settings& settings) {
  diagnosis::DiagnosisOptions how;
  how.threads = 1;
  how.only = settings.only;
  how.without = settings.without;
  return diagnosis::diagnose(set, how);
}

std::vector<Task> plan_tasks(const std::string& set, const std::vector<std::string>& only,
                             const std::vector<std::string>& without) {
  std::vector<Task> tasks;
  for (const std::string& number : list_cases(set)) tasks.push_back({number, only, without});
  return tasks;
}

AnswerTally run_cases(const RunOrder& order) {
  make_folder(order.out);
  return carry_out_answers(AnswerItems(order), order.out, order.threads, order.progress);
}

}  // namespace rollrig::validation
