#include "call.h"

#include <rollrig/stop.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

namespace rollrig::python {
namespace {

using namespace std::chrono_literals;

constexpr auto kBetweenLooks = 50ms;  // Assumed: Ctrl-C seems immediate
constexpr auto kUntilEnd = 10s;       // Assumed: longer than any step of a calculation

[[noreturn]] void wait_forever() {
  while (true) std::this_thread::sleep_for(1h);
}

/// Takes the GIL back. When Python is ending, it ends each thread that asks for the GIL by pthread_exit(). In C++ that
/// is an exception: it would run destructors without the GIL, and abort the process in a function that is noexcept. So
/// the thread is caught here, and waits until the process is gone.
void take_gil(PyThreadState* state) {
  try {
    PyEval_RestoreThread(state);
  } catch (...) {
    wait_forever();
  }
}

/// Calls of the library that are being carried out.
class RunningCalls {
 public:
  void begin() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_ending_) throw std::runtime_error("rollrig cannot be called any more: Python ends");
    ++count_;
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--count_ > 0) return;
    if (!is_ending_) clear_interrupt();  // it was requested of all calls, and none is left
    all_ended_.notify_all();
  }
  void end_all() {
    std::unique_lock<std::mutex> lock(mutex_);
    is_ending_ = true;
    request_interrupt();
    all_ended_.wait_for(lock, kUntilEnd, [this] { return count_ == 0; });
  }
  bool are_ending() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_ending_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_ended_;
  int count_ = 0;
  bool is_ending_ = false;
};

/// Never destroyed: threads may use it until the process is gone.
RunningCalls& running_calls() {
  static auto* calls = new RunningCalls;
  return *calls;
}

struct Counted {
  Counted() { running_calls().begin(); }
  ~Counted() { running_calls().end(); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
};

/// Takes the GIL back after a call, or after a look at one. When Python is ending, the call must have ended; then the
/// call is counted as ended, and this thread waits until the process is gone.
void take_gil(PyThreadState* state, bool is_ending) {
  if (is_ending) {
    running_calls().end();
    wait_forever();
  }
  take_gil(state);
}

/// Runs the signal handlers of Python, which it does in the main thread alone. Ctrl-C stops the calls of all threads.
void run_signal_handlers() {
  if (PyErr_CheckSignals() == 0) return;
  const py::error_already_set error;
  if (error.matches(PyExc_KeyboardInterrupt)) request_interrupt();
  throw error;
}

/// The thread that works, and what it tells the thread that waits.
class Call {
 public:
  Call(const std::function<void(const Progress&)>& work, bool tells_progress) {
    worker_ = std::thread([this, &work, tells_progress] { do_work(work, tells_progress); });
  }
  /// The work must have ended.
  ~Call() { worker_.join(); }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// Waits without the GIL, until the work has ended or it is time to look again. Returns whether it has ended.
  bool wait() {
    PyThreadState* state = PyEval_SaveThread();
    bool has_ended = false;
    bool is_ending = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      has_ended = ended_.wait_for(lock, kBetweenLooks, [this] { return has_ended_; });
      is_ending = running_calls().are_ending();
      if (is_ending) ended_.wait(lock, [this] { return has_ended_; });
    }
    take_gil(state, is_ending);
    return has_ended;
  }
  /// Calls `show` where the work has told of progress since the last time.
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
    stop_.request();
    while (!wait()) continue;
  }
  void throw_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void do_work(const std::function<void(const Progress&)>& work, bool tells_progress) {
    try {
      const StopScope scope(stop_);
      const Progress progress = [this](double done, const std::string& stage) { note(done, stage); };
      work(tells_progress ? progress : Progress());
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

  Stop stop_;
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
  const Counted counted;
  Call call(work, !show.is_none());
  try {
    while (!call.wait()) {
      run_signal_handlers();
      if (!show.is_none()) call.show(show);
    }
  } catch (...) {
    call.stop();
    throw;
  }
  call.throw_failure();
}

void do_without_gil(const std::function<void()>& work) {
  std::exception_ptr failure;
  {
    const Counted counted;
    PyThreadState* state = PyEval_SaveThread();
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    take_gil(state, running_calls().are_ending());
  }
  if (failure) std::rethrow_exception(failure);
}

void end_calls() {
  PyThreadState* state = PyEval_SaveThread();
  running_calls().end_all();
  take_gil(state);
}

}  // namespace rollrig::python
