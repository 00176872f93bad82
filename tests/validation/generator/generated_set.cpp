#include "tests/validation/generator/generated_set.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "measurements/resimulation.h"
#include "measurements/sample_selection.h"
#include "models/corner.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/standstill_grid.h"
#include "sim/fixed_grid_integrator.h"
#include "sim/simulate.h"
#include "tests/support/run_program.h"
#include "tests/validation/generator/vehicle_resimulation.h"

namespace rollrig::tests {
namespace {

/// Channels that the runs of a set have, the force first.
std::vector<std::string> find_channels(const measurements::MeasurementSet& set) {
  std::vector<std::string> channels;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    if (set.runs.front().has(channel)) channels.push_back(channel.header());
  }
  return channels;
}

/// Sums squares of a difference over rows, the force on a carriage 30 s after changes of load or acceleration left out.
class FloorSum {
 public:
  explicit FloorSum(const measurements::MeasurementSet& set) : set_(set) {}

  void add(const measurements::MeasuredRun& run, const std::string& channel, const std::vector<double>& other) {
    std::vector<bool> settled(run.time_s.size(), true);
    const models::MachineTraits& machine = set_.kind->traits;
    if (has_skim(machine) && channel == machine.force.header()) settled = measurements::find_settled_rows(run);
    const std::vector<double>& own = run.columns.at(channel);
    for (std::size_t row = 0; row < own.size(); ++row) {
      if (std::isnan(own[row]) || std::isnan(other[row]) || !settled[row]) continue;
      const double floors = (own[row] - other[row]) / calc_floor(set_, channel);
      sum_[channel] += floors * floors;
      count_[channel] += 1.0;
    }
  }

  Floors take() const {
    Floors floors;
    for (const auto& [channel, sum] : sum_) floors[channel] = std::sqrt(sum / count_.at(channel));
    return floors;
  }

 private:
  const measurements::MeasurementSet& set_;
  std::map<std::string, double> sum_;
  std::map<std::string, double> count_;
};

sim::Recording<double> resimulate_tire_rig(const measurements::MeasurementSet& set,
                                           const measurements::MeasuredRun& run) {
  models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), {});
  rigs::RigStart<double> start;
  start.tire_temperature_K = run.initial_tire_temperature_K;
  start.cold_pressure_Pa = run.cold_pressure_Pa;
  start.ambient_pressure_Pa = set.rig->environment.ambient_pressure_Pa;
  start.history.soaked = !run.rest_before_s.has_value();
  start.history.rest_before_s = run.rest_before_s.value_or(0.0);
  rigs::QuasiStaticDrum<double> drum(corner, start, false, rigs::Detail::kMeasured);
  sim::FixedGridIntegrator<double> integrator(drum);
  return sim::simulate<double>(drum, integrator,
                               rigs::refine_near_standstill(measurements::make_recorded_program(run, *set.kind),
                                                            rigs::index_of(rigs::DrumInput::kSpeed)));
}

}  // namespace

GeneratedSet make_generated_set(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string truth = folder.file("truth.json");
  const auto made = run_validation("make-case " + arguments + " --out " + folder.file("set") + " --counterfactual " +
                                   folder.file("without") + " --truth " + truth);
  INFO("rollrig_validation make " << arguments << "\n" << made.err);
  REQUIRE(made.status == 0);
  return {measurements::read_measurement_set(folder.file("set")),
          measurements::read_measurement_set(folder.file("without")), Json::parse(read_file(truth))};
}

GeneratedSet make_effect_set(const std::string& kind, const std::string& effect, const std::string& size, int seed) {
  return make_generated_set(
      fmt::format("--kind {} --effect {} --size {} --seed {} --noise-free --nominal-base", kind, effect, size, seed));
}

std::map<std::string, std::vector<std::string>> list_forms() {
  std::istringstream in(run_validation("list").out);
  std::map<std::string, std::vector<std::string>> forms;
  std::string effect;
  const std::string mark = "  form     ";
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.front() != ' ') effect = line.substr(0, line.find(' '));
    if (line.rfind(mark, 0) == 0) forms[effect].push_back(line.substr(mark.size(), line.find(':') - mark.size()));
  }
  return forms;
}

std::string with_form(const std::string& kind, const std::string& form) { return kind + " --form " + form; }

std::vector<double> find_difference(const GeneratedSet& made, std::size_t run, const std::string& channel) {
  std::vector<double> difference = made.set.runs[run].columns.at(channel);
  const std::vector<double>& without = made.counterfactual.runs[run].columns.at(channel);
  for (std::size_t row = 0; row < difference.size(); ++row) difference[row] -= without[row];
  return difference;
}

double calc_floor(const measurements::MeasurementSet& set, const std::string& channel) {
  constexpr double kFarApart_s = 1e6;  // so that the drift of both means has nothing in common
  return std::sqrt(0.5 * models::calc_difference_variance(set.sensors.at(channel), 10, 1.0, kFarApart_s));
}

Floors compare_with_baseline(const measurements::MeasurementSet& set) {
  FloorSum sum(set);
  for (const measurements::MeasuredRun& run : set.runs) {
    if (!has_skim(set.kind->traits)) {
      const auto baseline = resimulate_vehicle(set, run);
      for (const std::string& channel : find_channels(set)) sum.add(run, channel, baseline.at(channel));
      continue;
    }
    const sim::Recording<double> baseline = resimulate_tire_rig(set, run);
    for (const std::string& channel : find_channels(set)) sum.add(run, channel, baseline.channel(channel));
  }
  return sum.take();
}

Floors compare(const measurements::MeasurementSet& a, const measurements::MeasurementSet& b) {
  FloorSum sum(a);
  for (std::size_t r = 0; r < a.runs.size(); ++r) {
    for (const std::string& channel : find_channels(a)) sum.add(a.runs[r], channel, b.runs[r].columns.at(channel));
  }
  return sum.take();
}

}  // namespace rollrig::tests
