#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "build_paths.h"
#include "comparison/compare_results.h"
#include "diagnosis/loop/ledger.h"
#include "estimation/alignment/alignment.h"
#include "estimation/drum_deceleration/coast_set.h"
#include "estimation/road_load/coastdown_file.h"
#include "estimation/rolling_law/rolling_points.h"
#include "exports/coefficients.h"
#include "exports/tree.h"
#include "include/rollrig/sweep.h"
#include "measurements/logs/guess.h"
#include "measurements/logs/import.h"
#include "measurements/sensor_file.h"
#include "scenarios/common/speed_trace.h"
#include "scenarios/run/golden.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/scaffold/tire_size.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "sim/core/unit_names.h"
#include "tables/log_table.h"
#include "tables/tir_file.h"
#include "tests/fuzz/target.h"
#include "validation/scoring/answer.h"

namespace fs = std::filesystem;

namespace rollrig::fuzz {
namespace {

using Parts = std::vector<std::string>;
using Seeds = std::vector<std::string>;

const fs::path kRoot = ROLLRIG_SOURCE_DIR;
constexpr std::size_t kSeedLines = 40;  // of a seed's tables: short inputs are quick to read

std::string read_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

std::string first_lines(const std::string& text) {
  std::size_t end = 0;
  for (std::size_t line = 0; line < kSeedLines && end != std::string::npos && end < text.size(); ++line) {
    end = text.find('\n', end + (line > 0 ? 1 : 0));
  }
  return text.substr(0, end == std::string::npos ? end : end + 1);
}

/// Files of the tree below a folder whose names begin and end so, in the order of their paths.
std::vector<fs::path> find_files(const std::string& folder, const std::string& begin, const std::string& ending) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const std::string name = entry.path().filename().string();
    const bool ends =
        name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    if (entry.is_regular_file() && name.rfind(begin, 0) == 0 && ends) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

Seeds read_seeds(const std::vector<fs::path>& files) {
  Seeds seeds;
  for (const fs::path& file : files) {
    const std::string content = read_bytes(file);
    seeds.push_back(file.extension() == ".csv" ? first_lines(content) : content);
  }
  return seeds;
}

Seeds read_seeds(const std::string& folder, const std::string& begin, const std::string& ending) {
  return read_seeds(find_files(folder, begin, ending));
}

void append(Seeds more, Seeds& seeds) {
  seeds.insert(seeds.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// A kind of TOML file that stands by itself.
using ReadToml = std::function<void(const ConfigTable&)>;

Target make_toml_target(const std::string& name, const std::string& assets, const std::string& bad, ReadToml read) {
  const auto read_text = [read = std::move(read)](const std::string& text) {
    if (text.empty()) return;
    read(parse_config(text, "fuzz.toml"));
  };
  const auto make_seeds = [assets, bad] {
    Seeds seeds = read_seeds("assets/" + assets, "", ".toml");
    append(read_seeds("tests/bad_input", bad, ".toml"), seeds);
    return seeds;
  };
  return {name, {}, read_text, make_seeds};
}

const std::vector<std::string>& files_of_set() {
  static const std::vector<std::string> files{"set.toml", "tire.toml", "rig.toml", "run.csv"};
  return files;
}

/// A set's files as parts; of its runs the first, under the name run.csv.
std::string bundle_set(const fs::path& folder) {
  Parts parts;
  for (const char* name : {"set.toml", "tire.toml", "rig.toml"}) parts.push_back(read_bytes(folder / name));
  std::vector<fs::path> tables;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") tables.push_back(entry.path());
  }
  std::sort(tables.begin(), tables.end());
  if (!tables.empty()) {
    parts.push_back(first_lines(read_bytes(tables.front())));
    const std::string name = tables.front().filename().string();
    for (std::size_t at = parts[0].find(name); at != std::string::npos; at = parts[0].find(name, at + 7)) {
      parts[0].replace(at, name.size(), "run.csv");
    }
  }
  return join_parts(parts);
}

Seeds bundle_sets() {
  Seeds seeds{bundle_set(kRoot / "assets/examples/hidden_effect")};
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(kRoot / "tests/bad_input")) {
    if (entry.is_directory() && fs::exists(entry.path() / "set.toml")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) seeds.push_back(bundle_set(folder));
  return seeds;
}

Seeds bundle_imports() {
  const fs::path logs = kRoot / "assets/examples/logs";
  const std::string tire = read_bytes(logs / "tire.toml");
  const Parts tables{first_lines(read_bytes(logs / "torque.csv")), first_lines(read_bytes(logs / "tire.csv"))};
  Seeds seeds;
  std::vector<fs::path> mappings = find_files("tests/bad_input", "import_", ".toml");
  mappings.insert(mappings.begin(), logs / "import.toml");
  for (const fs::path& mapping : mappings)
    seeds.push_back(join_parts({read_bytes(mapping), tire, tables[0], tables[1]}));
  return seeds;
}

Seeds bundle_results() {
  const std::string result = R"({"format": "rollrig-result/1", "scenario": "warm_up", "result": {"rrc_N_per_kN": 8.5,
 "cycles": [{"load_N": 4000, "name": "first"}, {"load_N": 5000.5, "name": "second"}], "is_warm": true}})";
  const std::string recording =
      "time_s,phase,speed_km_h,liner_temperature_degC\n0,rest,0,25\n1,run,80,25.1\n2,run,80,\n";
  return {join_parts({result, recording, R"({"format": "rollrig-manifest/1"})"})};
}

/// A run with a budget and an energy audit, compared with itself.
std::string make_compared_seed() {
  const std::string result = R"({"format": "rollrig-result/1", "scenario": "skim", "result": {"rrc_N_per_kN": 6.5,
 "sections": [{"name": "city 1", "energy_J": 2}]}, "phases": [{"name": "skim", "start_s": 0, "end_s": 1}],
 "energy": {"terms_J": {"motor": 10, "tire_loss": -9, "heat_generated": 9}}, "uncertainty": {"budgets": [{"name": "RRc",
 "key": "rrc_N_per_kN", "value": 6.5, "contributions": [{"name": "gain", "key": "gain_percent", "type": "B",
 "sensitivity": 1, "contribution": 0.1, "degrees_of_freedom": null}]}]}})";
  const std::string manifest = R"({"format": "rollrig-manifest/1", "seed": 1, "settings": {"load_N": 5000},
 "tire": {"name": "a50", "load_map": []}, "rig": {"name": "drum_2m"}, "vehicle": {"axles": [{"tire": {}}]}})";
  return join_parts({result, manifest, "time_s,phase,speed_km_h\n0,skim,80\n1,skim,80\n"});
}

Seeds bundle_coasts() {
  Seeds seeds;
  std::vector<fs::path> sets = find_files("tests/bad_input", "coastdown_", ".toml");
  const std::vector<fs::path> example = find_files("assets/examples/drum_coastdown", "", ".toml");
  sets.insert(sets.begin(), example.begin(), example.end());
  const std::string table = first_lines(read_bytes(kRoot / "tests/bad_input/coastdown_good.csv"));
  for (const fs::path& set : sets) seeds.push_back(join_parts({read_bytes(set), table}));
  return seeds;
}

Seeds make_words() {
  return {"205/55R16 91",
          "195/75 R16C 107/105",
          "P225/45ZR17",
          "315/80 R 22.5 156/150",
          "mile/hour",
          "kPa (g)",
          "lbf.ft",
          "degC",
          "bar abs.",
          "2024-03-05T13:29:42.464+01:00",
          "05.03.2024 13:29:42,5",
          "5-Mar-24",
          "1:29:42 PM",
          "pressure_kPa=210:310:20",
          "tire=a40,a50",
          "speed_km_h=80,100,120"};
}

/// Calls what throws std::invalid_argument for a text that it does not understand.
template <class Parse>
void attempt(const Parse& parse) {
  try {
    parse();
  } catch (const std::invalid_argument&) {
  } catch (const InputError&) {
  }
}

void read_words(const std::string& text) {
  attempt([&] { scenarios::parse_tire_size(text); });
  attempt([&] { scenarios::parse_load_index(text); });
  attempt([&] { parse_unit(text, unit_of_key("x_kPa")); });
  attempt([&] { parse_unit(text, unit_of_key("x_km_h")); });
  for (const std::string& order : measurements::date_orders()) {
    attempt([&] { measurements::parse_date_days(text, order); });
    attempt([&] { measurements::parse_date_time_s(text, order); });
  }
  attempt([&] { measurements::parse_clock_s(text); });
  attempt([&] { measurements::parse_iso_8601(text); });
  attempt([&] { read_sweep_axis(text); });
  attempt([&] {
    ConfigTable document = scenarios::make_run_document("warm_up");
    scenarios::set_run_value(document, text);
  });
  parse_number(text);
}

std::string in(const std::string& folder, const char* name) { return (fs::path(folder) / name).string(); }

void read_guessed(const std::string& folder) {
  GuessOptions options;
  options.folder = in(folder, "log.csv");
  options.tire = "a50";
  options.rig = "drum_2m";
  const measurements::Guess guess = measurements::guess_logs(options);
  measurements::list_guesses(guess);
  if (!measurements::are_files_of_set(guess)) measurements::write_guessed_mapping(guess, folder);
}

void read_import(const std::string& folder) {
  const measurements::Mapping mapping = measurements::read_mapping(in(folder, "import.toml"));
  const measurements::Import imported = measurements::import_logs(mapping);
  measurements::make_set_files(mapping, imported);
  measurements::make_import_json(mapping, imported);
}

void read_result(const std::string& folder) {
  const exports::Group tree = exports::read_source(folder);
  exports::make_mat(tree);
  exports::make_hdf5(tree);
}

/// A log by what it begins with; each reader of a binary format reads in a process of its own.
Target make_table_target(const std::string& name, const char* file) {
  const auto read = [file](const std::string& folder) { tables::read_log_table(in(folder, file), {}, "t"); };
  const auto make_seeds = [ending = fs::path(file).extension().string()] {
    Seeds seeds = read_seeds("tests/bad_input", "", ending);
    append(read_seeds("tests/fuzz/seeds", "", ending), seeds);
    return seeds;
  };
  return {name, {file}, read, make_seeds};
}

std::vector<Target> make_targets() {
  std::vector<Target> targets;
  targets.push_back(
      make_toml_target("tire", "tires", "tire_", [](const ConfigTable& config) { models::read_tire(config); }));
  targets.push_back(make_toml_target("rig", "rigs", "rig_", [](const ConfigTable& config) { rigs::read_rig(config); }));
  targets.push_back(make_toml_target("vehicle", "vehicles", "vehicle_",
                                     [](const ConfigTable& config) { rigs::read_vehicle(config); }));
  targets.push_back(make_toml_target("sensors", "sensors", "set_sensor",
                                     [](const ConfigTable& config) { measurements::read_sensor_file(config); }));
  targets.push_back(make_toml_target("run", "regression", "run_", [](const ConfigTable& config) {
    scenarios::prepare_run(scenarios::read_run_spec(config, (kRoot / "assets/regression").string()));
  }));
  targets.push_back({"set", files_of_set(),
                     [](const std::string& folder) { measurements::read_measurement_set(folder); }, bundle_sets});
  targets.push_back({"set_bad_rows", files_of_set(),
                     [](const std::string& folder) { measurements::read_measurement_set(folder, BadRows::kLeaveOut); },
                     bundle_sets});
  targets.push_back({"import", {"import.toml", "tire.toml", "torque.csv", "tire.csv"}, read_import, bundle_imports});
  targets.push_back({"guess", {"log.csv"}, read_guessed, [] {
                       Seeds seeds = read_seeds("assets/examples/own_logs", "", ".csv");
                       append(read_seeds("tests/bad_input", "guess_", ".csv"), seeds);
                       return seeds;
                     }});
  targets.push_back({"cycle",
                     {"cycle.csv"},
                     [](const std::string& folder) { scenarios::read_speed_trace(in(folder, "cycle.csv")); },
                     [] {
                       Seeds seeds = read_seeds("assets/cycles", "", ".csv");
                       append(read_seeds("tests/bad_input", "cycle_", ".csv"), seeds);
                       return seeds;
                     }});
  targets.push_back({"road_load",
                     {"coastdowns.csv"},
                     [](const std::string& folder) { estimation::read_coastdowns(in(folder, "coastdowns.csv")); },
                     [] {
                       Seeds seeds = read_seeds("assets/examples", "coastdown", ".csv");
                       append(read_seeds("tests/bad_input", "coastdown_", ".csv"), seeds);
                       return seeds;
                     }});
  targets.push_back({"compared_results",
                     {"result.json", "manifest.json", "recording.csv"},
                     [](const std::string& folder) {
                       comparison::compare_results({folder, folder}, {"a", "b"});
                     },
                     [] { return Seeds{make_compared_seed()}; }});
  targets.push_back({"alignment",
                     {"tires.csv"},
                     [](const std::string& folder) {
                       AlignmentInput input;
                       input.file = in(folder, "tires.csv");
                       input.preliminary = true;
                       estimation::align_machine(estimation::read_alignment_file(input), input);
                     },
                     [] {
                       Seeds seeds = read_seeds("assets/examples", "alignment", ".csv");
                       append(read_seeds("tests/bad_input", "align_", ".csv"), seeds);
                       return seeds;
                     }});
  targets.push_back({"rolling_points",
                     {"points.csv"},
                     [](const std::string& folder) { estimation::read_rolling_test(in(folder, "points.csv")); },
                     [] {
                       Seeds seeds = read_seeds("assets/examples", "j2452", ".csv");
                       append(read_seeds("tests/bad_input", "j2452_", ".csv"), seeds);
                       return seeds;
                     }});
  targets.push_back({"rolling_result",
                     {"result.json"},
                     [](const std::string& folder) { estimation::read_rolling_test(in(folder, "result.json")); },
                     [] { return read_seeds("tests/bad_input", "j2452_other", ".json"); }});
  targets.push_back({"rolling_fit",
                     {"fit.json"},
                     [](const std::string& folder) { exports::read_rolling_coefficients(in(folder, "fit.json")); },
                     [] { return read_seeds("tests/bad_input", "j2452_fit", ".json"); }});
  targets.push_back({"drum_coastdown",
                     {"set.toml", "coastdown_good.csv"},
                     [](const std::string& folder) { estimation::read_coast_set(in(folder, "set.toml")); },
                     bundle_coasts});
  targets.push_back({"golden",
                     {"run.golden.csv"},
                     [](const std::string& folder) { scenarios::read_golden(in(folder, "run.golden.csv")); },
                     [] { return read_seeds("assets/regression", "", ".golden.csv"); }});
  targets.push_back({"ledger",
                     {"ledger.json"},
                     [](const std::string& folder) { diagnosis::read_ledger(in(folder, "ledger.json")); },
                     [] { return Seeds{to_text(diagnosis::make_ledger_json({}))}; }});
  targets.push_back({"answer",
                     {"0001.json"},
                     [](const std::string& folder) { validation::find_answer(folder, "0001"); },
                     [] { return Seeds{to_text(validation::make_answer_json({}))}; }});
  targets.push_back({"result", {"result.json", "recording.csv", "manifest.json"}, read_result, bundle_results});
  targets.push_back({"tir",
                     {"tire.tir"},
                     [](const std::string& folder) { tables::read_tir(in(folder, "tire.tir")); },
                     [] {
                       Seeds seeds = read_seeds("tests/bad_input", "tir_", ".tir");
                       append(read_seeds("tests/fuzz/seeds", "", ".tir"), seeds);
                       return seeds;
                     }});
  targets.push_back({"words", {}, read_words, make_words});
  targets.push_back(make_table_target("mat", "log.mat"));
  targets.push_back(make_table_target("hdf5", "log.h5"));
  targets.push_back(make_table_target("mdf4", "log.mf4"));
  return targets;
}

constexpr std::string_view kPartMark = "\x1e\n";

}  // namespace

const std::vector<Target>& list_targets() {
  static const std::vector<Target> targets = make_targets();
  return targets;
}

const Target& find_target(const std::string& name) {
  for (const Target& target : list_targets()) {
    if (target.name == name) return target;
  }
  throw std::out_of_range("no target '" + name + "'");
}

std::string join_parts(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, kPartMark)); }

std::vector<std::string> split_parts(std::string_view input) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t at = input.find(kPartMark);
    parts.emplace_back(input.substr(0, at));
    if (at == std::string_view::npos) return parts;
    input.remove_prefix(at + kPartMark.size());
  }
}

void execute(const Target& target, std::string_view input, const std::string& folder) {
  std::vector<std::string> parts = split_parts(input);
  parts.resize(std::max(parts.size(), target.files.size()));
  for (std::size_t i = 0; i < target.files.size(); ++i) {
    std::ofstream(fs::path(folder) / target.files[i], std::ios::binary) << parts[i];
  }
  try {
    target.read(target.files.empty() ? std::string(input) : folder);
  } catch (const InputError&) {
  } catch (const RunFailure&) {
  }
}

}  // namespace rollrig::fuzz
