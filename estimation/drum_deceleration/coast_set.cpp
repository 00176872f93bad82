#include "estimation/drum_deceleration/coast_set.h"

#include <fmt/format.h>
#include <boost/math/constants/constants.hpp>

#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "estimation/run_checks/checked_rows.h"
#include "sim/core/data_file.h"

namespace fs = std::filesystem;

namespace rollrig::estimation {
namespace {

constexpr Range kSpeedRange = between(0.0, 400.0);      // km/h
constexpr Range kInertiaRange = between(1e-4, 1e9);     // kg m2, as of a rig file
constexpr Range kDiameterRange = between(0.1, 1000.0);  // m, likewise
constexpr Range kRadiusRange = between(0.01, 10.0);     // m. Assumed: from a kart to a mining truck
constexpr Range kPulsesRange = between(1e-3, 1e9);      // Assumed: from one in a thousand turns to a fine encoder
constexpr double kDefaultSpeeds_km_h[] = {40.0, 60.0, 80.0, 100.0};

void read_drum(TableReader& top, CoastSet& set) {
  const ConfigTable* table = top.table("drum");
  if (table == nullptr) throw top.problem("drum", "the set has no [drum]", "[drum] with diameter_m");
  TableReader reader(*table, "[drum]");
  set.drum_diameter_m = reader.number({"diameter_m", kDiameterRange, "Diameter"});
  set.drum_inertia_kg_m2 = reader.number_or_none({"inertia_kg_m2", kInertiaRange, "I_D"});
  if (const auto pulses = reader.number_or_none({"pulses_per_revolution", kPulsesRange, ""})) {
    set.drum_pulse_length_m = boost::math::constants::pi<double>() * set.drum_diameter_m / *pulses;
  }
  reader.finish();
}

void read_wheel(TableReader& top, CoastSet& set) {
  const ConfigTable* table = top.table("wheel");
  if (table == nullptr) return;
  TableReader reader(*table, "[wheel]");
  set.wheel_inertia_kg_m2 = reader.number_or_none({"inertia_kg_m2", kInertiaRange, "I_T"});
  set.wheel_rolling_radius_m = reader.number_or_none({"rolling_radius_m", kRadiusRange, "R_r"});
  set.wheel_mass_ratio = reader.number_or_none({"mass_ratio", between(0.0, 1.0), "mu"});
  const auto pulses = reader.number_or_none({"pulses_per_revolution", kPulsesRange, ""});
  if ((set.wheel_inertia_kg_m2.has_value() || pulses.has_value()) && !set.wheel_rolling_radius_m.has_value()) {
    throw reader.problem("rolling_radius_m", "the wheel's inertia and pulses ask for its rolling radius", "> 0");
  }
  if (set.wheel_inertia_kg_m2.has_value() && set.wheel_mass_ratio.has_value()) {
    throw reader.problem("mass_ratio", "the wheel's share is given twice", "inertia_kg_m2 or mass_ratio");
  }
  if (set.wheel_inertia_kg_m2.has_value() && !set.drum_inertia_kg_m2.has_value()) {
    throw reader.problem("inertia_kg_m2", "the wheel's inertia is given without the drum's",
                         "[drum] inertia_kg_m2 too, or mass_ratio here");
  }
  if (pulses.has_value()) {
    set.wheel_pulse_length_m = boost::math::constants::two_pi<double>() * *set.wheel_rolling_radius_m / *pulses;
  }
  reader.finish();
}

void read_analysis(TableReader& top, CoastSet& set) {
  for (const double speed_km_h : kDefaultSpeeds_km_h) set.speeds_m_s.push_back(speed_km_h / 3.6);
  set.reference_speed_m_s = 80.0 / 3.6;
  const ConfigTable* table = top.table("analysis");
  if (table == nullptr) return;
  TableReader reader(*table, "[analysis]");
  set.speeds_m_s = reader.numbers_or({"speeds_km_h", between(1.0, 400.0), ""}, set.speeds_m_s);
  set.reference_speed_m_s = reader.number_or_none({"reference_speed_km_h", between(1.0, 400.0), ""})
                                .value_or(set.speeds_m_s[set.speeds_m_s.size() / 2]);
  set.reference_pressure_Pa = reader.number_or_none({"reference_pressure_kPa", positive(), ""});
  set.half_band_m_s = reader.number_or_none({"half_band_km_h", between(1.0, 100.0), ""}).value_or(set.half_band_m_s);
  set.find_resonance = reader.flag_or("find_resonance", true);
  set.leave_out_m_s = reader.numbers_or({"leave_out_km_h", kSpeedRange, ""}, {});
  if (!set.leave_out_m_s.empty() && (set.leave_out_m_s.size() != 2 || set.leave_out_m_s[0] >= set.leave_out_m_s[1])) {
    throw reader.problem("leave_out_km_h", "a range of speed has two ends", "[from, to] with from < to");
  }
  reader.finish();
}

CoastSeries take_series(const CheckedRows& rows, const std::vector<std::size_t>& of_body,
                        const std::vector<double>& time_s, const std::vector<double>& speed_m_s) {
  CoastSeries series;
  for (const std::size_t row : of_body) {
    if (rows.is_out(row)) continue;
    series.time_s.push_back(time_s[row]);
    series.speed_m_s.push_back(speed_m_s[row]);
  }
  return series;
}

/// Columns src, t_s, speed_mps: both bodies in one file.
void read_two_bodies(CheckedRows& rows, CoastRun& run) {
  const CsvTable& csv = rows.table();
  csv.require_known({"src", "t_s", "speed_mps"});
  const std::vector<std::string> src = csv.text("src");
  const std::vector<double> time_s = rows.numbers({"t_s", any_number(), ""});
  const std::vector<double> speed_m_s = rows.numbers({"speed_mps", between(0.0, 120.0), ""});
  for (std::size_t row = 0; row < src.size(); ++row) {
    if (src[row] == "D" || src[row] == "W") continue;
    rows.leave_out(csv.cell_error(row, "src", fmt::format("'{}' is no body", src[row]), "D (drum) or W (wheel)"));
  }
  for (const char* body : {"D", "W"}) {
    std::vector<std::size_t> of_body;
    for (std::size_t row = 0; row < src.size(); ++row) {
      if (src[row] == body) of_body.push_back(row);
    }
    rows.check_times("t_s", of_body, time_s, "");
    CoastSeries series = take_series(rows, of_body, time_s, speed_m_s);
    if (!series.time_s.empty()) (body[0] == 'D' ? run.drum : run.wheel) = std::move(series);
  }
}

void read_one_body(CheckedRows& rows, CoastBody body, CoastRun& run) {
  rows.table().require_known({"time_s", "speed_km_h"});
  const std::vector<double> time_s = rows.numbers({"time_s", any_number(), ""});
  const std::vector<double> speed_m_s = rows.numbers({"speed_km_h", kSpeedRange, ""});
  std::vector<std::size_t> all(rows.row_count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  rows.check_times("time_s", all, time_s, "");
  (body == CoastBody::kDrum ? run.drum : run.wheel) = take_series(rows, all, time_s, speed_m_s);
}

CoastRun read_run(const ConfigTable& table, const std::string& folder) {
  TableReader reader(table, "[[run]]");
  CoastRun run;
  run.id = reader.text("file");
  run.file = place_data_file(reader, "file", folder, run.id);
  run.state = reader.text("state", {"loaded", "lifted"}) == "loaded" ? CoastState::kLoaded : CoastState::kLifted;
  const Field pressure{"pressure_kPa", between(20.0, 2000.0), "gauge"};
  run.pressure_Pa =
      run.state == CoastState::kLoaded ? reader.number(pressure) : reader.number_or_none(pressure).value_or(0.0);
  run.direction = reader.text_or("direction", "");
  run.load_N = reader.number_or_none({"load_N", positive(), ""}).value_or(0.0);
  const bool wheel = reader.text_or("body", "drum", {"drum", "wheel"}) == "wheel";
  reader.finish();
  CheckedRows rows(run.file);
  const CsvTable& csv = rows.table();
  if (csv.has("src") || csv.has("t_s") || csv.has("speed_mps")) {
    read_two_bodies(rows, run);
  } else {
    read_one_body(rows, wheel ? CoastBody::kWheel : CoastBody::kDrum, run);
  }
  run.left_out = rows.list_left_out();
  return run;
}

/// Refuses the bad rows of all files, or too many in one of them.
void settle_bad_rows(const CoastSet& set, BadRows bad_rows) {
  const std::vector<const CoastRun*> bad = list_runs_with_bad_rows(set);
  if (bad.empty()) return;
  if (bad_rows == BadRows::kLeaveOut) {
    for (const CoastRun* run : bad) measurements::require_few_bad_rows(run->left_out, run->file, "");
    return;
  }
  std::map<std::string, measurements::FileProblems> files;
  for (const CoastRun& run : set.runs) files[run.file] = run.left_out;
  std::vector<measurements::FileProblems> problems;
  for (const auto& [file, some] : files) problems.push_back(some);
  throw measurements::make_bad_rows_error(problems, "");
}

void require_states(const TableReader& reader, const CoastSet& set) {
  bool loaded = false;
  bool lifted = false;
  for (const CoastRun& run : set.runs) {
    loaded = loaded || (run.state == CoastState::kLoaded && run.drum.has_value());
    lifted = lifted || (run.state == CoastState::kLifted && run.drum.has_value());
  }
  if (!loaded)
    throw reader.problem("run", "no run has the tire loaded on the drum", "a [[run]] with state = \"loaded\"");
  if (!lifted) {
    throw reader.problem("run", "no run has the drum alone: its own loss cannot be taken off",
                         "a [[run]] with state = \"lifted\"");
  }
  const bool lifted_wheel = std::any_of(set.runs.begin(), set.runs.end(), [](const CoastRun& run) {
    return run.state == CoastState::kLifted && run.wheel.has_value();
  });
  if (set.calc_mass_ratio() > 0.0 && !lifted_wheel) {
    throw reader.problem("run",
                         "[wheel] gives the wheel's share of the inertia, and no run has the lifted wheel alone: its "
                         "own loss cannot be taken off",
                         "a [[run]] with state = \"lifted\" and body = \"wheel\"; or no inertia_kg_m2 and no "
                         "mass_ratio in [wheel]: the wheel's own loss then stays in the tire's");
  }
}

/// Where loads differ, every loaded run needs its own; where they do not, runs without one have that of the others.
void complete_loads(const TableReader& reader, CoastSet& set) {
  double known_N = 0.0;
  const CoastRun* other = nullptr;
  for (const CoastRun& run : set.runs) {
    if (run.state != CoastState::kLoaded || run.load_N == 0.0) continue;
    if (known_N == 0.0) known_N = run.load_N;
    if (!is_same_load(run.load_N, known_N)) other = &run;
  }
  for (CoastRun& run : set.runs) {
    if (run.state != CoastState::kLoaded || run.load_N > 0.0) continue;
    if (other != nullptr) {
      throw reader.problem("run",
                           fmt::format("the loads of the runs differ ({:g} N, and {:g} N in {}), and {} has none",
                                       known_N, other->load_N, other->id, run.id),
                           "load_N in every loaded [[run]]");
    }
    run.load_N = known_N;
  }
}

}  // namespace

std::optional<double> CoastSet::calc_drum_mass_kg() const {
  if (!drum_inertia_kg_m2.has_value()) return std::nullopt;
  const double radius_m = drum_diameter_m / 2.0;
  return *drum_inertia_kg_m2 / (radius_m * radius_m);
}

double CoastSet::calc_mass_ratio() const {
  if (wheel_mass_ratio.has_value()) return *wheel_mass_ratio;
  const std::optional<double> drum_kg = calc_drum_mass_kg();
  if (!drum_kg.has_value() || !wheel_inertia_kg_m2.has_value()) return 0.0;
  return *wheel_inertia_kg_m2 / (*wheel_rolling_radius_m * *wheel_rolling_radius_m) / *drum_kg;
}

bool CoastSet::is_mass_ratio_known() const { return wheel_mass_ratio.has_value() || wheel_inertia_kg_m2.has_value(); }

std::vector<const CoastRun*> list_runs_with_bad_rows(const CoastSet& set) {
  std::vector<const CoastRun*> runs;
  std::set<std::string> files;
  for (const CoastRun& run : set.runs) {
    if (!run.left_out.problems.empty() && files.insert(run.file).second) runs.push_back(&run);
  }
  return runs;
}

CoastSet read_coast_set(const std::string& path, const std::string& data_folder, BadRows bad_rows) {
  const ConfigTable config = read_config(path);
  TableReader reader(config, "");
  check_format(reader, "rollrig-drum-coastdown", 1);
  CoastSet set;
  set.path = path;
  set.name = reader.text_or("name", fs::path(path).stem().string());
  read_drum(reader, set);
  read_wheel(reader, set);
  read_analysis(reader, set);
  const std::string folder = data_folder.empty() ? fs::path(path).parent_path().string() : data_folder;
  for (const ConfigTable* table : reader.tables("run")) set.runs.push_back(read_run(*table, folder));
  reader.finish();
  settle_bad_rows(set, bad_rows);
  require_states(reader, set);
  complete_loads(reader, set);
  return set;
}

}  // namespace rollrig::estimation
