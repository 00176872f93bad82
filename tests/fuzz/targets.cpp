#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "api/campaign_definition.h"
#include "campaigns/store.h"
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
#include "sim/core/text.h"
#include "sim/core/unit_names.h"
#include "tables/formats.h"
#include "tables/log_table.h"
#include "tables/tir_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/target.h"
#include "validation/scoring/answer.h"

namespace fs = std::filesystem;

namespace rollrig::fuzz {
namespace {

/// A kind of TOML file that stands by itself.
using ReadToml = std::function<void(const ConfigTable&)>;

Target make_toml_target(const std::string& name, const std::string& assets, const std::string& bad, ReadToml read) {
  const auto read_text = [read = std::move(read)](const std::string& text) {
    if (text.empty()) return;
    read(parse_config(text, "fuzz.toml"));
  };
  const auto make_seeds = [assets, bad] {
    return read_seeds({{"assets/" + assets, "", ".toml"}, {"tests/bad_input", bad, ".toml"}});
  };
  return {name, {}, read_text, make_seeds};
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
  attempt([&] { scenarios::parse_service_description(text); });
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

/// The inputs of a run, as a program of each kind of machine.
void read_program(const std::string& folder) {
  for (const rigs::MachineKind* kind : rigs::machine_kinds()) {
    attempt([&] { measurements::read_run_inputs(in(folder, "program.csv"), *kind); });
  }
}

/// The file of one machine, and of the two of the example.
void read_alignment(const std::string& folder) {
  AlignmentInput input;
  input.file = in(folder, "tires.csv");
  input.preliminary = true;
  attempt([&] { estimation::align_machine(estimation::read_alignment_file(input), input); });
  input.machine = "drum_B";
  input.reference_machine = "drum_A";
  estimation::align_machine(estimation::read_alignment_file(input), input);
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
  return {name, {file}, read, [ending = fs::path(file).extension().string()] {
            return read_seeds({{"tests/bad_input", "", ending}, {"tests/fuzz/seeds", "", ending}});
          }};
}

/// The same reader in this process: from another, neither the edges that it covers nor its crashes are seen.
Target make_direct_target(const std::string& name, const char* file, tables::Columns (*reader)(const std::string&)) {
  Target target = make_table_target(name, file);
  target.read = [file, reader](const std::string& folder) { reader(in(folder, file)); };
  return target;
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
    scenarios::prepare_run(scenarios::read_run_spec(config, (source_folder() / "assets/regression").string()));
  }));
  targets.push_back({"set", files_of_set(),
                     [](const std::string& folder) { measurements::read_measurement_set(folder); }, bundle_sets});
  targets.push_back({"set_bad_rows", files_of_set(),
                     [](const std::string& folder) { measurements::read_measurement_set(folder, BadRows::kLeaveOut); },
                     bundle_sets});
  targets.push_back({"import", {"import.toml", "tire.toml", "torque.csv", "tire.csv"}, read_import, bundle_imports});
  targets.push_back(
      {"guess", {"log.csv"}, read_guessed, [] {
         return read_seeds({{"assets/examples/own_logs", "", ".csv"}, {"tests/bad_input", "guess_", ".csv"}});
       }});
  targets.push_back(
      {"program", {"program.csv"}, read_program, [] {
         return read_seeds({{"assets/regression", "follow_", "50.csv"}, {"tests/bad_input", "program_", ".csv"}});
       }});
  targets.push_back({"cycle",
                     {"cycle.csv"},
                     [](const std::string& folder) { scenarios::read_speed_trace(in(folder, "cycle.csv")); },
                     [] {
                       return read_seeds({{"assets/cycles", "", ".csv"}, {"tests/bad_input", "cycle_", ".csv"}});
                     }});
  targets.push_back(
      {"road_load",
       {"coastdowns.csv"},
       [](const std::string& folder) { estimation::read_coastdowns(in(folder, "coastdowns.csv")); },
       [] {
         return read_seeds({{"assets/examples", "coastdown", ".csv"}, {"tests/bad_input", "coastdown_", ".csv"}});
       }});
  targets.push_back({"recorded_coast",
                     {"recording.csv", "manifest.json"},
                     [](const std::string& folder) { estimation::read_coastdowns(folder); },
                     bundle_recorded_coasts});
  targets.push_back({"compared_results",
                     {"result.json", "manifest.json", "recording.csv"},
                     [](const std::string& folder) {
                       comparison::compare_results({folder, folder}, {"a", "b"});
                     },
                     bundle_compared_results});
  targets.push_back(
      {"alignment", {"tires.csv"}, read_alignment, [] {
         return read_seeds({{"assets/examples", "alignment", ".csv"}, {"tests/bad_input", "align_", ".csv"}});
       }});
  targets.push_back({"reference_values",
                     {"tires.csv", "values.csv"},
                     [](const std::string& folder) {
                       AlignmentInput input;
                       input.file = in(folder, "tires.csv");
                       input.reference_values = in(folder, "values.csv");
                       estimation::read_alignment_file(input);
                     },
                     bundle_reference_values});
  targets.push_back({"stored_alignment",
                     {"alignment.json"},
                     [](const std::string& folder) { estimation::read_alignment_json(in(folder, "alignment.json")); },
                     make_alignments});
  targets.push_back({"rolling_points",
                     {"points.csv"},
                     [](const std::string& folder) { estimation::read_rolling_test(in(folder, "points.csv")); },
                     [] {
                       return read_seeds({{"assets/examples", "j2452", ".csv"}, {"tests/bad_input", "j2452_", ".csv"}});
                     }});
  targets.push_back({"rolling_result",
                     {"result.json"},
                     [](const std::string& folder) { estimation::read_rolling_test(in(folder, "result.json")); },
                     [] {
                       return read_seeds({{"tests/bad_input", "j2452_other", ".json"}});
                     }});
  targets.push_back({"rolling_fit",
                     {"fit.json"},
                     [](const std::string& folder) { exports::read_rolling_coefficients(in(folder, "fit.json")); },
                     [] {
                       return read_seeds({{"tests/bad_input", "j2452_fit", ".json"}});
                     }});
  targets.push_back({"drum_coastdown",
                     {"set.toml", "coastdown_good.csv"},
                     [](const std::string& folder) { estimation::read_coast_set(in(folder, "set.toml")); },
                     bundle_drum_coasts});
  targets.push_back({"golden",
                     {"run.golden.csv"},
                     [](const std::string& folder) { scenarios::read_golden(in(folder, "run.golden.csv")); },
                     [] {
                       return read_seeds({{"assets/regression", "", ".golden.csv"}});
                     }});
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
                       return read_seeds({{"tests/bad_input", "tir_", ".tir"}, {"tests/fuzz/seeds", "", ".tir"}});
                     }});
  targets.push_back(
      {"campaign", {}, [](const std::string& text) { CampaignDefinition::read(text, "fuzz.json"); }, make_campaigns});
  targets.push_back({"campaign_results",
                     {"results"},
                     [](const std::string& folder) {
                       campaigns::read_records({in(folder, "results")}, kCampaign, [](const campaigns::Record&) {});
                     },
                     make_campaign_results});
  targets.push_back({"words", {}, read_words, make_words});
  targets.push_back(make_table_target("mat", "log.mat"));
  targets.push_back(make_table_target("hdf5", "log.h5"));
  targets.push_back(make_table_target("mdf4", "log.mf4"));
  targets.push_back(make_direct_target("mdf4_direct", "log.mf4", tables::read_mdf4));
  targets.push_back(make_direct_target("mat_direct", "log.mat", tables::read_mat));
  targets.push_back(make_direct_target("hdf5_direct", "log.h5", tables::read_hdf5));
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
