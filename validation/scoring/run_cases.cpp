#include "validation/scoring/run_cases.h"

#include <ctime>

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

/// The answer to a task, and whether it was there before: one that still holds, else one made and written now.
std::pair<Answer, bool> answer_task(const RunOrder& order, const Task& task, const std::string& program) {
  const std::string folder = case_folder(order.set, task.number);
  Answer answer;
  answer.number = task.number;
  answer.set_sha256 = hash_case(folder);
  answer.settings = {program, task.only, task.without};
  std::optional<Answer> before = find_answer(order.out, task.number);
  if (before && before->set_sha256 == answer.set_sha256 && before->settings == answer.settings) {
    return {*std::move(before), true};
  }
  diagnose(folder, order.answer_by, answer);
  write_answer(order.out, answer);
  return {std::move(answer), false};
}

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
  std::vector<Task> own;
  for (std::size_t i = 0; i < order.tasks.size(); ++i) {
    if (order.part.has(i)) own.push_back(order.tasks[i]);
  }
  const std::string program = hash_program();
  RunTally tally;
  std::mutex mutex;
  try {
    parallel_for(own.size(), order.threads, [&](std::size_t i) {
      const auto [answer, was_there] = answer_task(order, own[i], program);
      const std::lock_guard<std::mutex> lock(mutex);
      ++(was_there ? tally.kept : tally.made);
      if (!answer.failure.empty()) tally.failures[answer.number] = answer.failure;
      if (order.progress) order.progress(tally.kept + tally.made, own.size());
    });
  } catch (const Interrupted&) {
    tally.interrupted = true;
  }
  return tally;
}

}  // namespace rollrig::validation
