#include "call.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace rollrig::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};  // Assumed: Ctrl-C seems immediate

/// Calls of the library that are being carried out. An interruption stops all of them, since it is one of the process;
/// it is taken back when the last of them has ended.
class RunningCalls {
 public:
  void begin() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--count_ == 0) clear_interrupt();
  }

 private:
  std::mutex mutex_;
  int count_ = 0;
};

RunningCalls& running_calls() {
  static RunningCalls calls;
  return calls;
}

/// What the thread that works tells the thread that waits.
class Call {
 public:
  explicit Call(const std::function<void(const Progress&)>& work) {
    running_calls().begin();
    worker_ = std::thread([this, &work] { do_work(work); });
  }
  ~Call() {
    {
      const py::gil_scoped_release released;
      worker_.join();
    }
    running_calls().end();
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// Whether it has ended within the time.
  bool wait() {
    const py::gil_scoped_release released;
    std::unique_lock<std::mutex> lock(mutex_);
    return ended_.wait_for(lock, kBetweenLooks, [this] { return has_ended_; });
  }
  /// Shows news, with the GIL.
  void show(const py::object& show) {
    double done = 0.0;
    std::string stage;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!has_news_) return;
      has_news_ = false;
      done = done_;
      stage = stage_;
    }
    show(done, stage);
  }
  void stop() {
    request_interrupt();
    while (!wait()) continue;
  }
  void throw_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void do_work(const std::function<void(const Progress&)>& work) {
    try {
      work([this](double done, const std::string& stage) { note(done, stage); });
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
    ended_.notify_one();
  }
  void note(double done, const std::string& stage) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = done;
    stage_ = stage;
    has_news_ = true;
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  bool has_news_ = false;
  double done_ = 0.0;
  std::string stage_;
  std::exception_ptr failure_;
  std::thread worker_;
};

}  // namespace

void carry_out(const py::object& show, const std::function<void(const Progress&)>& work) {
  Call call(work);
  try {
    while (!call.wait()) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!show.is_none()) call.show(show);
    }
  } catch (...) {
    call.stop();
    throw;
  }
  call.throw_failure();
}

}  // namespace rollrig::python
