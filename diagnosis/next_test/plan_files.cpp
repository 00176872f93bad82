#include "diagnosis/next_test/plan_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "diagnosis/next_test/test_menu.h"
#include "measurements/sample_selection.h"
#include "sim/core/csv.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

using rigs::MachineKind;

/// What a plan names, by whether it is made on a rig or on the road.
struct PlanWords {
  const char* machine;  // of the run, as key and file
  const char* occupied;
  const char* place;
};

PlanWords find_words(const MachineKind& kind) {
  if (!kind.names_rig()) return {"vehicle", "the vehicle", "On the road"};
  return {"rig", "the rig", "At the rig"};
}

/// Given columns of a run of the kind, as far as it has them.
std::vector<Quantity> find_given_columns(const MeasuredRun& run, const MachineKind& kind) {
  std::vector<Quantity> columns;
  for (const rigs::Column& column : kind.columns.all_given()) {
    if (run.has(column.quantity)) columns.push_back(column.quantity);
  }
  return columns;
}

/// Whether a row says nothing that its neighbors do not: the load goes on, all else lies on a straight line.
bool is_between(const MeasuredRun& run, const std::vector<Quantity>& columns, std::size_t row) {
  constexpr double kSame = 1e-9;
  const double share = (run.time_s[row] - run.time_s[row - 1]) / (run.time_s[row + 1] - run.time_s[row - 1]);
  return std::all_of(columns.begin(), columns.end(), [&](const Quantity& quantity) {
    const std::vector<double>& values = run.column(quantity);
    const double before = values[row - 1];
    const double expected = quantity == quantities::kLoad ? before : before + share * (values[row + 1] - before);
    return std::abs(values[row] - expected) <= kSame * (1.0 + std::abs(expected));
  });
}

std::string write_inputs(const MeasuredRun& run, const MachineKind& kind) {
  const std::vector<Quantity> columns = find_given_columns(run, kind);
  CsvWriter csv(list_headers(columns, {"time_s"}));
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const bool is_end = row == 0 || row + 1 == run.time_s.size();
    if (!is_end && is_between(run, columns, row)) continue;
    csv.add(run.time_s[row]);
    for (const Quantity& column : columns) csv.add(column.file_unit().from_si(run.column(column)[row]));
    csv.end_row();
  }
  return csv.take();
}

/// The interval of the set's own rows, as far as a run takes it.
double find_sample_interval_s(const MeasurementSet& set) {
  const double mean_s = measurements::calc_mean_interval_s(set.runs.front());
  return std::clamp(std::round(100.0 * mean_s) / 100.0, 0.01, 60.0);
}

/// The set's sensors, and those of its kind that the test reads and the set has not.
models::SensorSet find_sensors(const MeasurementSet& set, const ProposedTest& test) {
  models::SensorSet sensors = set.sensors;
  for (const auto& [channel, sensor] : set.kind->default_sensors) {
    const bool is_read = std::any_of(test.runs.begin(), test.runs.end(),
                                     [&channel = channel](const MeasuredRun& run) { return run.has(channel); });
    if (is_read) sensors.emplace(channel, sensor);
  }
  return sensors;
}

/// `number` of `count` runs.
std::string write_run_file(const MeasurementSet& set, const ProposedTest& test, std::size_t index, std::size_t number,
                           std::size_t count) {
  const MeasuredRun& run = test.runs[index];
  const PlanWords words = find_words(*set.kind);
  const bool is_combined = set.baseline == models::Baseline::kCombined;
  std::string text = fmt::format(
      "# Run {0} of {1}: {2}\nformat = \"rollrig-run/1\"\nscenario = \"{3}\"\ntire = \"tire.toml\"\n{4} = "
      "\"{4}.toml\"\nbaseline = \"{5}\"\nseed = {0}\nsample_interval_s = {6:.10g}\n",
      number, count, test.test, set.kind->follow_scenario, words.machine, is_combined ? "combined" : "constant_rrc",
      find_sample_interval_s(set));
  const std::vector<double>& speed_m_s = run.column(quantities::kSpeed);
  const bool stands = std::all_of(speed_m_s.begin(), speed_m_s.end(), [](double speed) { return speed == 0.0; });
  // Where nothing turns, mechanics have nothing to say, and no work of a motor to hold their audit against.
  if (stands && !is_of_vehicle(set.kind->traits)) text += "fidelity = \"quasi_static\"\n";
  text += fmt::format(
      "\n[settings]\nprogram = \"{}.csv\"\npressure_kPa = {:.10g}\ninitial_tire_temperature_degC = {:.10g}\n", run.id,
      run.cold_pressure_Pa / 1e3, run.initial_tire_temperature_K - kZeroCelsius_K);
  // A run of the other kinds begins where a soak ends.
  if (!is_of_vehicle(set.kind->traits)) text += fmt::format("soak_h = {:.10g}\n", test.soaked ? kSoak_h : 0.0);
  if (test.force_at_standstill) text += "force_at_standstill = \"yes\"\n";
  return text + measurements::write_sensors(find_sensors(set, test));
}

/// One stage of a run: what is held, and how long.
struct Stage {
  double speed_m_s = 0.0;
  double load_N = 0.0;
  double pull_N = 0.0;  // drive force of the wheel
  double duration_s = 0.0;
};

bool holds_same(const Stage& a, const Stage& b) {
  return a.speed_m_s == b.speed_m_s && a.load_N == b.load_N && a.pull_N == b.pull_N;
}

/// Stages of constant speed, load and force; changes of speed count to what follows.
std::vector<Stage> find_stages(const MeasuredRun& run) {
  const std::vector<double>& load_N = run.column(quantities::kLoad);
  const std::vector<double>& speed_m_s = run.column(quantities::kSpeed);
  const std::vector<double>* pull_N =
      run.has(quantities::kLongitudinalForce) ? &run.column(quantities::kLongitudinalForce) : nullptr;
  std::vector<Stage> stages;
  double since_s = run.time_s.front();
  for (std::size_t row = 0; row + 1 < run.time_s.size(); ++row) {
    if (speed_m_s[row + 1] != speed_m_s[row]) continue;  // on the way
    const double end_s = run.time_s[row + 1];
    const Stage held{speed_m_s[row], load_N[row], pull_N != nullptr ? (*pull_N)[row] : 0.0, end_s - since_s};
    if (!stages.empty() && holds_same(stages.back(), held) && since_s == run.time_s[row]) {
      stages.back().duration_s += held.duration_s;
    } else {
      stages.push_back(held);
    }
    since_s = end_s;
  }
  return stages;
}

/// What a stage asks of the wheel beside its speed; nothing on the road.
std::string describe_force(const Stage& stage, const MachineKind& kind) {
  if (is_on_road(kind.traits)) return "";
  const std::string load = stage.load_N > 0.0 ? fmt::format("  {:.0f} N", stage.load_N) : "  tire lifted";
  if (stage.pull_N == 0.0) return load;
  return load + fmt::format(", {} with {:.0f} N", stage.pull_N > 0.0 ? "driving" : "braking", std::abs(stage.pull_N));
}

std::string describe_stage(const Stage& stage, const MachineKind& kind) {
  const std::string speed = stage.speed_m_s > 0.0 ? fmt::format("{:.0f} km/h", 3.6 * stage.speed_m_s) : "standstill";
  const std::string force = describe_force(stage, kind);
  return fmt::format("     {:6.1f} min   {:<{}}{}\n", stage.duration_s / 60.0, speed, force.empty() ? 0 : 11, force);
}

std::string describe_run(const ProposedTest& test, std::size_t index, std::size_t number, const MachineKind& kind) {
  const MeasuredRun& run = test.runs[index];
  const double ambient_degC = run.column(quantities::kAmbient).front() - kZeroCelsius_K;
  std::string text = fmt::format("  Run {0}: run-{0}.toml, {1}.csv, {2:.0f} min\n", number, run.id,
                                 (run.time_s.back() - run.time_s.front()) / 60.0);
  const std::vector<Stage> stages = find_stages(run);
  const bool is_warmed = !stages.empty() && stages.front().speed_m_s > 0.0;
  const char* any_start = is_warmed ? "warm or cold, the first stage warms the tire; air" : "warm or cold; air";
  text += fmt::format("     {} {:.1f} degC, {:.1f} kPa cold\n", test.soaked ? "soak for 3 h at" : any_start,
                      ambient_degC, run.cold_pressure_Pa / 1e3);
  for (const Stage& stage : stages) text += describe_stage(stage, kind);
  return text;
}

/// The table of a run in a set.toml that it is to be put into.
std::string write_plan_run(const ProposedTest& test, const MeasuredRun& run) {
  const char* zero = test.force_at_standstill ? "force_at_standstill = true\n" : "";
  return fmt::format(
      "\n[[run]]\nid = \"{0}\"\nfile = \"{0}_measured.csv\"  # what the rig recorded; {0}.csv is the program\n"
      "session = \"{1}\"\ninitial_tire_temperature_degC = "
      "{2:.10g}  # as it was\ncold_pressure_kPa = {3:.10g}  # as it was\n{4}{5}",
      run.id, run.session, run.initial_tire_temperature_K - kZeroCelsius_K, run.cold_pressure_Pa / 1e3, zero,
      run.reversed ? "reversed = true\n" : "");
}

std::string indent_lines(const std::string& text) {
  std::string indented;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) indented += line.empty() ? "\n" : "  " + line + "\n";
  return indented;
}

std::string write_plan_text(const MeasurementSet& set, const ProposedTest& test) {
  const PlanWords words = find_words(*set.kind);
  std::string text = fmt::format("Next test for the set '{}'\n\n{}\n", set.name, wrap(test.test, 2));
  text += test.splits.empty() ? "  Separates no two causes; it narrows down what is open\n"
                              : wrap(fmt::format("Separates: {}", fmt::join(test.splits, ", ")), 2);
  text += fmt::format("  Takes {:.1f} h of {}, set-up included; expected {:.2g} bits an hour\n\n", test.hours,
                      words.occupied, test.expected_bits_per_hour);
  text += fmt::format("{}, in this order\n\n", words.place);
  text += describe_runs(test, 0, *set.kind);
  text += "On paper first: what the simulation without any effect expects, as a set\n\n";
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    text += fmt::format("  rollrig run run-{0}.toml --write-set set-{0}\n", i + 1);
  }
  text +=
      "\n  With --set effects.<id>.<parameter>=... the same with an effect on.\n\nAfterwards: put the runs into the "
      "set's set.toml and diagnose it again\n";
  for (const MeasuredRun& run : test.runs) text += indent_lines(write_plan_run(test, run));
  return text;
}

}  // namespace

std::string describe_runs(const ProposedTest& test, std::size_t before, const MachineKind& kind) {
  std::string text;
  for (std::size_t i = 0; i < test.runs.size(); ++i) text += describe_run(test, i, before + i + 1, kind) + "\n";
  for (const std::string& step : test.by_hand) text += wrap(step, 2);
  return test.by_hand.empty() ? text : text + "\n";
}

std::map<std::string, std::string> write_test_files(const MeasurementSet& set, const std::vector<ProposedTest>& tests) {
  std::map<std::string, std::string> files;
  std::size_t count = 0;
  for (const ProposedTest& test : tests) count += test.runs.size();
  std::size_t number = 0;
  for (const ProposedTest& test : tests) {
    for (std::size_t i = 0; i < test.runs.size(); ++i) {
      ++number;
      files[fmt::format("run-{}.toml", number)] = write_run_file(set, test, i, number, count);
      files[test.runs[i].id + ".csv"] = write_inputs(test.runs[i], *set.kind);
    }
  }
  files["tire.toml"] = set.tire.content.empty() ? models::write_tire(set.tire) : set.tire.content;
  if (!set.kind->names_rig()) {
    files.merge(rigs::write_vehicle_files(*set.vehicle, set.vehicle->content));
  } else {
    files["rig.toml"] = set.rig->content.empty() ? rigs::write_rig(*set.rig) : set.rig->content;
  }
  return files;
}

std::string write_set_to_fill(const MeasurementSet& set, const std::vector<ProposedTest>& tests) {
  const bool names_rig = set.kind->names_rig();
  std::string text = fmt::format("{}name = \"{}\"\n{}tire = \"tire.toml\"\n{}\nbaseline = \"{}\"\n",
                                 measurements::write_set_format(*set.kind), set.name,
                                 names_rig ? "" : fmt::format("kind = \"{}\"\n", set.kind->set_word),
                                 names_rig ? "rig = \"rig.toml\"" : "vehicle = \"vehicle.toml\"",
                                 set.baseline == models::Baseline::kCombined ? "combined" : "constant_rrc");
  models::SensorSet sensors = set.sensors;
  for (const ProposedTest& test : tests) sensors.merge(find_sensors(set, test));
  text += measurements::write_sensors(sensors);
  for (const ProposedTest& test : tests) {
    for (const MeasuredRun& run : test.runs) text += write_plan_run(test, run);
  }
  return text;
}

std::map<std::string, std::string> write_plan(const MeasurementSet& set, const Diagnosis& diagnosis) {
  if (!diagnosis.plan.has_value()) return {};
  std::map<std::string, std::string> files = write_test_files(set, {*diagnosis.plan});
  files["plan.txt"] = write_plan_text(set, *diagnosis.plan);
  return files;
}

}  // namespace rollrig::diagnosis
