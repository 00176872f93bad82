#include "validation/scoring/run_cases.h"

#include <ctime>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>

#include "measurements/measurement_set.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
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

class CaseRun {
 public:
  explicit CaseRun(const RunOrder& order) : order_(order), program_(hash_program()) {
    for (std::size_t i = order.rank; i < order.tasks.size(); i += order.ranks) own_.push_back(order.tasks[i]);
  }

  RunTally run() {
    try {
      parallel_for(own_.size(), order_.threads, [this](std::size_t i) { answer(own_[i]); });
    } catch (const Interrupted&) {
      interrupted_ = true;
    }
    return {kept_, made_, failures_, interrupted_};
  }

 private:
  void answer(const Task& task) {
    throw_if_interrupted();
    const std::string folder = case_folder(order_.set, task.number);
    Answer answer;
    answer.number = task.number;
    answer.set_sha256 = hash_case(folder);
    answer.settings = {program_, task.only, task.without};
    const std::optional<Answer> before = find_answer(order_.out, task.number);
    if (before && before->set_sha256 == answer.set_sha256 && before->settings == answer.settings) {
      ++kept_;
      note_failure(*before);
    } else {
      diagnose(folder, order_.answer_by, answer);
      write_answer(order_.out, answer);
      ++made_;
      note_failure(answer);
    }
    if (order_.progress) order_.progress(kept_ + made_, own_.size());
  }

  void note_failure(const Answer& answer) {
    if (answer.failure.empty()) return;
    const std::lock_guard<std::mutex> lock(failures_mutex_);
    failures_[answer.number] = answer.failure;
  }

  const RunOrder& order_;
  std::string program_;
  std::vector<Task> own_;
  std::atomic<std::size_t> kept_{0};
  std::atomic<std::size_t> made_{0};
  std::map<std::string, std::string> failures_;
  std::mutex failures_mutex_;
  bool interrupted_ = false;
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

RunTally run_cases(const RunOrder& order) {
  make_folder(order.out);
  return CaseRun(order).run();
}

}  // namespace rollrig::validation
