#include "serve/jobs.h"

#include <algorithm>
#include <cmath>

#include "serve/error_json.h"

namespace rollrig::serve {
namespace {

constexpr std::size_t kMostWaiting = 4;  // Assumed: one person, who waits for them
constexpr std::size_t kMostKept = 16;    // Assumed: jobs that the page can still ask about

}  // namespace

Jobs::Jobs() : thread_([this] { work_off(); }) {}

Jobs::~Jobs() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
    for (auto& [id, job] : jobs_) job.is_canceled = true;
  }
  changed_.notify_all();
  thread_.join();
}

const char* Jobs::name_state(State state) {
  constexpr const char* kNames[] = {"waiting", "running", "done", "failed", "canceled"};
  return kNames[static_cast<int>(state)];
}

std::size_t Jobs::count(State state) const {
  return static_cast<std::size_t>(
      std::count_if(jobs_.begin(), jobs_.end(), [state](const auto& item) { return item.second.state == state; }));
}

void Jobs::forget_old() {
  for (auto at = jobs_.begin(); at != jobs_.end() && jobs_.size() > kMostKept;) {
    const bool is_over = at->second.state != State::kWaiting && at->second.state != State::kRunning;
    at = is_over ? jobs_.erase(at) : std::next(at);
  }
}

int Jobs::add(const std::string& name, Work work) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (count(State::kWaiting) >= kMostWaiting) throw Refusal(503, "too many diagnoses wait; cancel one or try later");
  forget_old();
  const int id = next_++;
  jobs_[id].name = name;
  jobs_[id].work = std::move(work);
  changed_.notify_all();
  return id;
}

Jobs::Job& Jobs::find(int id) {
  const auto at = jobs_.find(id);
  if (at == jobs_.end()) throw Refusal(404, "there is no such job");
  return at->second;
}

Json Jobs::describe(int id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Job& job = const_cast<Jobs*>(this)->find(id);
  Json json{{"name", job.name},
            {"state", name_state(job.state)},
            {"done", std::isfinite(job.done) ? Json(job.done) : Json()},
            {"stage", job.stage}};
  if (!job.result.is_null()) json["result"] = job.result;
  if (!job.error.is_null()) json["error"] = job.error;
  return json;
}

Json Jobs::list() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Json jobs = Json::array();
  for (const auto& [id, job] : jobs_) {
    jobs.push_back({{"job", id}, {"name", job.name}, {"state", name_state(job.state)}});
    if (job.result.contains("kept")) jobs.back()["kept"] = job.result["kept"];
  }
  return {{"jobs", jobs}};
}

void Jobs::cancel(int id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Job& job = find(id);
  job.is_canceled = true;
  if (job.state == State::kWaiting) job.state = State::kCanceled;
}

void Jobs::work_off() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    const auto find_next = [this] {
      return std::find_if(jobs_.begin(), jobs_.end(), [](auto& item) { return item.second.state == State::kWaiting; });
    };
    changed_.wait(lock, [&] { return is_ending_ || find_next() != jobs_.end(); });
    if (is_ending_) return;
    carry_out(lock, find_next()->second);  // it stays: only jobs that are over are forgotten
  }
}

void Jobs::carry_out(std::unique_lock<std::mutex>& lock, Job& job) {
  job.state = State::kRunning;
  const Work work = std::move(job.work);
  lock.unlock();
  const Progress progress = [this, &job](double done, const std::string& stage) {
    const std::lock_guard<std::mutex> inner(mutex_);
    if (job.is_canceled) throw Interrupted();
    job.done = done;
    job.stage = stage;
  };
  Json result;
  Json error;
  State state = State::kDone;
  try {
    result = work(progress);
  } catch (const Interrupted&) {
    state = State::kCanceled;
  } catch (...) {
    state = State::kFailed;
    error = make_error_json(std::current_exception());
  }
  lock.lock();
  job.state = state;
  job.result = std::move(result);
  job.error = std::move(error);
}

}  // namespace rollrig::serve
