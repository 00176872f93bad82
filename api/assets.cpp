#include "rollrig/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "diagnosis/output/explain.h"
#include "rollrig/measurement_set.h"
#include "scenarios/common/speed_trace.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/core/columns.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "sim/core/units.h"
#include "tables/tir_file.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

std::string describe_scenario(const scenarios::Scenario& scenario) {
  std::string text = scenario.text.name + ": scenario\n" + wrap(scenario.text.summary, 2) + '\n';
  text += "Procedure\n" + wrap(scenario.text.procedure, 2) + "Source\n" + wrap(scenario.text.source, 2);
  text += "Settings (--set key=value)\n";
  std::vector<std::vector<std::string>> settings, results;
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    const std::string range = setting.range.empty() ? "" : ", " + setting.range;
    settings.push_back({setting.key, fmt::format("{} [{}{}]", setting.doc, setting.fallback, range)});
  }
  for (const scenarios::ResultInfo& result : scenario.results) results.push_back({result.key, result.doc});
  return text + text_columns(settings) + "Results\n" + text_columns(results);
}

/// A trace is read best in a plot; here what it comes to.
std::string describe_cycle(const std::string& path) {
  const scenarios::SpeedTrace trace = scenarios::read_speed_trace(path);
  double standing_s = 0.0;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    if (trace.speed_m_s[i] > 0.0 || trace.speed_m_s[i - 1] > 0.0) continue;
    standing_s += trace.time_s[i] - trace.time_s[i - 1];
  }
  const double fastest_m_s = *std::max_element(trace.speed_m_s.begin(), trace.speed_m_s.end());
  return path + "\n\n" +
         wrap(fmt::format("{}: drive cycle, {}, {:.0f} s, {:.3f} km, at most {:.1f} km/h, {:.0f} s at standstill",
                          trace.name, format_count(trace.time_s.size(), "row"), trace.duration_s(),
                          scenarios::calc_distance_m(trace.time_s, trace.speed_m_s) / 1e3, 3.6 * fastest_m_s,
                          standing_s),
              0);
}

/// The rolling resistance of a tire property file.
std::string describe_tir(const std::string& path) {
  const tables::TirFile tir = tables::read_tir(path);
  const double pressure_Pa = tir.pressure_Pa.value_or(1.0);
  std::string text = fmt::format("{}: tire property file, FITTYP {}\n", path, tir.version) +
                     wrap(fmt::format("Rolling resistance on a flat surface at nominal load, {:.0f} N{}", tir.load_N,
                                      tir.pressure_Pa.has_value()
                                          ? fmt::format(", and nominal pressure, {:.0f} kPa", 1e-3 * pressure_Pa)
                                          : ""),
                          0);
  Table table{"", {"km/h", "N", "RRc N/kN"}, {}};
  for (const double speed_km_h : {30.0, 60.0, 80.0, 100.0, 130.0}) {
    const double force_N = tables::calc_rolling_resistance_N(tir, tir.load_N, pressure_Pa, speed_km_h / kKmhPerMs);
    table.rows.push_back({fmt::format("{:.0f}", speed_km_h), fmt::format("{:.2f}", force_N),
                          fmt::format("{:.3f}", 1e3 * force_N / tir.load_N)});
  }
  text += format_table(table);
  text += fmt::format("  exponent of load (QSY7)      {:g}\n  exponent of pressure (QSY8)  {:g}\n",
                      tir.has_exponents() ? tir.coefficients[6] : 1.0, tir.has_exponents() ? tir.coefficients[7] : 0.0);
  for (const std::string& warning : tir.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

bool is_path(const std::string& name) {
  const std::string extension = fs::path(name).extension().string();
  return name.find('/') != std::string::npos || extension == ".toml" || extension == ".csv" || extension == ".tir";
}

/// What a file of the user's is, and the file; of a set its set.toml.
std::string describe_file(const std::string& given) {
  const std::string path = fs::is_directory(given) ? (fs::path(given) / "set.toml").string() : given;
  if (fs::path(path).extension() == ".csv") return describe_cycle(path);
  if (fs::path(path).extension() == ".tir") return describe_tir(path);
  return check_file(path).what + "\n" + path + "\n\n" + read_text_file(path);
}

}  // namespace

const std::vector<std::string>& asset_folders() {
  static const std::vector<std::string> folders{"tires", "rigs", "vehicles", "cycles", "sensors"};
  return folders;
}

std::vector<std::string> names_of(const std::vector<Listed>& listed) {
  std::vector<std::string> names;
  for (const Listed& one : listed) names.push_back(one.name);
  return names;
}

std::vector<Listed> list_scenarios() {
  std::vector<Listed> listed;
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    listed.push_back({scenario->text.name, scenario->text.summary});
  }
  return listed;
}

std::vector<Listed> list_effects() {
  std::vector<Listed> listed;
  for (const models::Effect* effect : models::all_effects()) {
    listed.push_back({effect->info.id, effect->info.summary});
  }
  return listed;
}

std::string describe(const std::string& name) {
  if (const auto* scenario = scenarios::find_scenario_if_any(name)) return describe_scenario(*scenario);
  std::vector<std::string> known = scenarios::scenario_names();
  const auto is_asked = [&](const std::string& each, const std::string& asked) {
    known.push_back(each);
    return each == asked;
  };
  for (const models::Effect* effect : models::all_effects()) {
    if (is_asked(effect->info.id, name)) return diagnosis::explain_effect(name);
  }
  for (const std::string& folder : asset_folders()) {
    for (const std::string& asset : list_assets(folder)) {
      if (!is_asked(asset, find_present_name(folder, name))) continue;
      const std::string path = find_asset(folder, name);
      // Source comments of an asset are part of what it says: the file itself is shown.
      return folder == "cycles" ? describe_cycle(path) : path + "\n\n" + read_text_file(path);
    }
  }
  if (is_path(name)) return describe_file(name);
  throw InputError(unknown_name("scenario, effect or asset", name, known));
}

}  // namespace rollrig
