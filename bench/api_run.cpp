/// Seconds that an ISO 28580 run takes through the API, one a line: api_run <number of runs>. python_run.py holds the
/// Python package against it.
#include <rollrig/rollrig.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 20;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    rollrig::RunInput input;
    input.scenario_or_file = "iso_28580";
    input.tire = "a50";
    rollrig::Run(input).carry_out();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    std::printf("%.6f\n", taken.count());
  }
}
