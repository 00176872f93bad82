/// Wall time and CPU time of a diagnosis on all cores, including the reading of the measurement set. The independent
/// generator makes the sets.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "diagnosis/diagnosis.h"
#include "measurements/measurement_set.h"
#include "sim/core/file_io.h"
#include "validation/generator/measurement_set.h"

namespace {

using namespace rollrig;

/// Writes a set with one effect into a temporary folder. The destructor removes the folder.
class SetFolder {
 public:
  SetFolder(const char* machine, int runs, const char* effect)
      : path_((std::filesystem::temp_directory_path() / ("rollrig-bench-" + std::to_string(getpid()))).string()) {
    generator::SetOrder order;
    order.machine = &generator::find_machine(machine, "machine");
    order.runs = runs;
    order.effects = {effect};
    order.sizes = {std::nullopt};
    OutputFolder folder(path_, true);
    for (const auto& [name, content] : generator::make_set(order, false).files) folder.add(name, content);
    folder.commit();
  }
  ~SetFolder() { std::filesystem::remove_all(path_); }
  SetFolder(const SetFolder&) = delete;
  SetFolder& operator=(const SetFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void diagnose(benchmark::State& state, const char* machine, int runs, const char* effect) {
  const SetFolder folder(machine, runs, effect);
  diagnosis::Diagnosis found;
  for (auto _ : state) found = diagnosis::diagnose(measurements::read_measurement_set(folder.path()), {});
  state.counters["probability"] = diagnosis::probability_of(found, effect);
}

BENCHMARK_CAPTURE(diagnose, six_drum_runs, "drum", 6, "slow_leak")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(diagnose, three_dynamometer_runs, "dyno", 3, "driveline_warming")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace

BENCHMARK_MAIN();
