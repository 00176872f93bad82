#pragma once
/// Work that takes minutes: one job at a time, the next ones wait; with progress, and stopped when asked.

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "rollrig/progress.h"
#include "sim/core/json.h"

namespace rollrig::serve {

class Jobs {
 public:
  /// What is to be done. Returns what the page gets; stops with Interrupted when `progress` throws it.
  using Work = std::function<Json(const Progress& progress)>;

  Jobs();
  /// Stops the running job and waits for it.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Number of the new job; `name` is what a person calls it. Throws Refusal where too many wait.
  int add(const std::string& name, Work work);
  /// {name, state: "waiting" | "running" | "done" | "failed" | "canceled", done, stage, result, error}. Throws Refusal
  /// where there is no such job.
  Json describe(int id) const;
  /// {jobs: [{job, name, state, kept}]}: those that are not forgotten, in their order; `kept` where the result has it.
  Json list() const;
  void cancel(int id);

 private:
  enum class State { kWaiting, kRunning, kDone, kFailed, kCanceled };
  struct Job {
    std::string name;
    Work work;
    State state = State::kWaiting;
    bool is_canceled = false;
    double done = 0.0;
    std::string stage;
    Json result;
    Json error;
  };

  static const char* name_state(State state);
  void work_off();
  void carry_out(std::unique_lock<std::mutex>& lock, Job& job);
  Job& find(int id);
  std::size_t count(State state) const;
  void forget_old();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, Job> jobs_;
  int next_ = 1;
  bool is_ending_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace rollrig::serve
