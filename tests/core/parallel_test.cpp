#include "sim/core/parallel.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace rollrig;

namespace {

/// Counts those that are inside at the same time.
class Gauge {
 public:
  void enter() {
    const int now = ++inside_;
    int seen = most_;
    while (now > seen && !most_.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    --inside_;
  }
  int most() const { return most_; }

 private:
  std::atomic<int> inside_{0};
  std::atomic<int> most_{0};
};

/// Each of `outer` jobs shares out `inner` jobs of its own.
std::vector<int> share_out_twice(std::size_t outer, std::size_t inner, int threads, Gauge& gauge) {
  std::vector<int> done(outer * inner, 0);
  parallel_for(outer, threads, [&](std::size_t i) {
    parallel_for(inner, threads, [&](std::size_t j) {
      gauge.enter();
      ++done[i * inner + j];
    });
  });
  return done;
}

}  // namespace

TEST_CASE("work within work is done once each, on no more threads than the outer one has", "[fast]") {
  for (const int threads : {1, 2}) {
    Gauge gauge;
    const std::vector<int> done = share_out_twice(5, 7, threads, gauge);
    CHECK(std::all_of(done.begin(), done.end(), [](int times) { return times == 1; }));
    CHECK(gauge.most() <= threads);
  }
}

TEST_CASE("an exception within work passes on through both", "[fast]") {
  const auto fail = [](std::size_t) { throw std::runtime_error("no"); };
  CHECK_THROWS_AS(parallel_for(3, 2, [&](std::size_t) { parallel_for(3, 2, fail); }), std::runtime_error);
}

TEST_CASE("after work within work, a thread shares out work of its own again", "[fast]") {
  Gauge gauge;
  share_out_twice(2, 2, 1, gauge);
  std::vector<int> done(4, 0);
  parallel_for(done.size(), 1, [&](std::size_t i) { done[i] = 1; });
  CHECK(std::count(done.begin(), done.end(), 1) == 4);
}
