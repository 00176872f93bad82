#include "tests/fuzz/seeds.h"

#include <fmt/format.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "api/campaign_definition.h"
#include "build_paths.h"
#include "campaigns/store.h"
#include "estimation/alignment/alignment.h"
#include "sim/core/file_io.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;

namespace rollrig::fuzz {
namespace {

using Parts = std::vector<std::string>;

constexpr std::size_t kSeedLines = 40;  // of a seed's tables

std::string read_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

std::vector<fs::path> find_files(const SeedPlace& place) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / place.folder)) {
    const std::string name = entry.path().filename().string();
    const bool has_name =
        boost::algorithm::starts_with(name, place.begin) && boost::algorithm::ends_with(name, place.ending);
    if (has_name && entry.is_regular_file()) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

Seeds read_files(const std::vector<fs::path>& files) {
  Seeds seeds;
  for (const fs::path& file : files) {
    const std::string content = read_bytes(file);
    seeds.push_back(file.extension() == ".csv" ? first_lines(content) : content);
  }
  return seeds;
}

/// A set's files as parts, in the order of files_of_set(); of its runs the first, under the name run.csv.
std::string bundle_set(const fs::path& folder) {
  Parts parts;
  for (const char* name : {"set.toml", "tire.toml", "rig.toml"}) parts.push_back(read_bytes(folder / name));
  std::vector<fs::path> tables;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") tables.push_back(entry.path());
  }
  std::sort(tables.begin(), tables.end());
  for (const fs::path& table : tables) {
    boost::algorithm::replace_all(parts[0], "\"" + table.filename().string() + "\"", "\"run.csv\"");
  }
  parts.push_back(tables.empty() ? "" : first_lines(read_bytes(tables.front())));
  parts.push_back(read_bytes(folder / "vehicle.toml"));
  return join_parts(parts);
}

}  // namespace

const fs::path& source_folder() {
  static const fs::path folder = ROLLRIG_SOURCE_DIR;
  return folder;
}

std::string first_lines(const std::string& text) {
  std::size_t end = 0;
  for (std::size_t line = 0; line < kSeedLines && end != std::string::npos && end < text.size(); ++line) {
    end = text.find('\n', end + (line > 0 ? 1 : 0));
  }
  return text.substr(0, end == std::string::npos ? end : end + 1);
}

Seeds read_seeds(const std::vector<SeedPlace>& places) {
  Seeds seeds;
  for (const SeedPlace& place : places) {
    Seeds more = read_files(find_files(place));
    seeds.insert(seeds.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return seeds;
}

const std::vector<std::string>& files_of_set() {
  static const std::vector<std::string> files{"set.toml", "tire.toml", "rig.toml", "run.csv", "vehicle.toml"};
  return files;
}

Seeds bundle_sets() {
  Seeds seeds{bundle_set(source_folder() / "assets/examples/hidden_effect")};
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(source_folder() / "tests/bad_input")) {
    if (entry.is_directory() && fs::exists(entry.path() / "set.toml")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) seeds.push_back(bundle_set(folder));
  return seeds;
}

Seeds bundle_imports() {
  const fs::path logs = source_folder() / "assets/examples/logs";
  const std::string tire = read_bytes(logs / "tire.toml");
  const Parts tables{first_lines(read_bytes(logs / "torque.csv")), first_lines(read_bytes(logs / "tire.csv"))};
  Seeds seeds;
  std::vector<fs::path> mappings = find_files({"tests/bad_input", "import_", ".toml"});
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

Seeds bundle_compared_results() {
  const std::string result = R"({"format": "rollrig-result/1", "scenario": "skim", "result": {"rrc_N_per_kN": 6.5,
 "sections": [{"name": "city 1", "energy_J": 2}]}, "phases": [{"name": "skim", "start_s": 0, "end_s": 1}],
 "energy": {"terms_J": {"motor": 10, "tire_loss": -9, "heat_generated": 9}}, "uncertainty": {"budgets": [{"name": "RRc",
 "key": "rrc_N_per_kN", "value": 6.5, "contributions": [{"name": "gain", "key": "gain_percent", "type": "B",
 "sensitivity": 1, "contribution": 0.1, "degrees_of_freedom": null}]}]}})";
  const std::string manifest = R"({"format": "rollrig-manifest/1", "seed": 1, "settings": {"load_N": 5000},
 "tire": {"name": "a50", "load_map": []}, "rig": {"name": "drum_2m"}, "vehicle": {"axles": [{"tire": {}}]}})";
  return {join_parts({result, manifest, "time_s,phase,speed_km_h\n0,skim,80\n1,skim,80\n"})};
}

Seeds bundle_drum_coasts() {
  Seeds seeds;
  std::vector<fs::path> sets = find_files({"tests/bad_input", "coastdown_", ".toml"});
  const std::vector<fs::path> example = find_files({"assets/examples/drum_coastdown", "", ".toml"});
  sets.insert(sets.begin(), example.begin(), example.end());
  const std::string table = first_lines(read_bytes(source_folder() / "tests/bad_input/coastdown_good.csv"));
  for (const fs::path& set : sets) seeds.push_back(join_parts({read_bytes(set), table}));
  return seeds;
}

Seeds bundle_recorded_coasts() {
  const std::string manifest = R"({"format": "rollrig-manifest/1", "settings": {"wheels": 4, "wind_m_s": 1,
 "slope_percent": 0.5}, "rig": {"environment": {"ambient_pressure_kPa": 101.3}}, "vehicle": {"body": {"mass_kg": 2000,
 "rotating_mass_kg": 60, "drag_area_m2": 0.6}}})";
  std::string recording = "time_s,phase,speed_km_h,ambient_degC\n0,settle,130,20\n";
  for (int row = 0; row < 20; ++row) {
    recording += fmt::format("{},coastdown 1{},{},20\n", 1 + row, row < 10 ? '+' : '-', 130 - 5 * (row % 10));
  }
  return {join_parts({recording, manifest})};
}

Seeds bundle_reference_values() {
  const fs::path bad = source_folder() / "tests/bad_input";
  const std::string values = read_bytes(bad / "align_unknown_tire_values.csv");
  const std::string known = boost::algorithm::replace_all_copy(values, "T44", "T4");
  const std::string tires = read_bytes(bad / "align_no_reference.csv");
  return {join_parts({tires, known}), join_parts({tires, values})};
}

Seeds make_alignments() {
  AlignmentInput input;
  input.file = (source_folder() / "assets/examples/alignment.csv").string();
  input.machine = "drum_B";
  input.reference_machine = "drum_A";
  const estimation::AlignmentFile file = estimation::read_alignment_file(input);
  Seeds seeds = read_seeds({{"tests/bad_input", "align_", ".json"}});
  seeds.push_back(to_text(estimation::make_alignment_json(file, estimation::align_machine(file, input))));
  return seeds;
}

Seeds make_campaigns() {
  CampaignDefinition runs;
  runs.version = "1.0.0";
  runs.files = {{"/tires/a50.toml", calc_sha256("tire")}};
  runs.run.scenario_or_file = "skim";
  runs.run.settings = {"load_N=4000"};
  runs.design.name = campaigns::kLatinHypercube;
  runs.design.points = 8;
  runs.design.factors = {campaigns::read_drawn_factor("speed_km_h=uniform:60:100"),
                         campaigns::read_drawn_factor("pressure_kPa=normal:250:5")};
  runs.design.correlated = {{0, 1, 0.5}};
  CampaignDefinition diagnoses;
  diagnoses.version = runs.version;
  diagnoses.files = runs.files;
  diagnoses.diagnosis.emplace();
  diagnoses.diagnosis->sets = {"/sets/one"};
  return {runs.to_text(), diagnoses.to_text()};
}

Seeds make_campaign_results() {
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("results");
  campaigns::Store store(path, kCampaign);
  store.write({0, calc_sha256("0"), 1, R"({"rrc_N_per_kN": 8.5})", ""});
  store.write({7, calc_sha256("7"), 2, "", "the tire is too hot"});
  store.close();
  return {read_bytes(path)};
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

}  // namespace rollrig::fuzz
