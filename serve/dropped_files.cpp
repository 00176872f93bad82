#include "serve/dropped_files.h"

#include <algorithm>
#include <filesystem>

#include "measurements/logs/guess.h"
#include "rigs/rig_file.h"
#include "serve/error_json.h"
#include "serve/page_words.h"
#include "sim/core/assets.h"

namespace fs = std::filesystem;

namespace rollrig::serve {
namespace {

std::string find_toml_kind(const std::string& path) {
  try {
    const ConfigTable config = read_config(path);
    TableReader reader(config, "");
    const std::string format = reader.text("format");
    const std::string word = format.substr(0, format.find('/'));
    for (const auto& [known, kind] :
         {std::pair{"rollrig-tire", "tire"}, std::pair{"rollrig-rig", "rig"}, std::pair{"rollrig-vehicle", "vehicle"},
          std::pair{"rollrig-sensors", "sensors"}, std::pair{"rollrig-measurements", "set"},
          std::pair{"rollrig-import", "mapping"}}) {
      if (word == known) return kind;
    }
  } catch (const InputError&) {  // what uses it says so
  }
  return "other";
}

/// Headings of the first log with its unit and the cells of its first rows.
Json list_headings(const std::string& folder) {
  constexpr std::size_t kRows = 3;
  Json headings = Json::array();
  for (const DroppedFile& file : list_dropped_files(folder)) {
    if (file.kind != "log") continue;
    const std::string path = folder + "/" + file.name;
    const measurements::GuessedForm form = measurements::guess_form(path);
    const CsvTable table = measurements::read_guessed_table(path, form);
    for (std::size_t i = 0; i < form.headings.size(); ++i) {
      const std::vector<std::string> cells = table.text(form.headings[i]);
      headings.push_back(
          {{"name", form.headings[i]},
           {"unit", i < form.units.size() ? form.units[i] : ""},
           {"examples", std::vector<std::string>(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(
                                                                                    std::min(kRows, cells.size())))}});
    }
    break;
  }
  return headings;
}

/// The columns that a set of this machine takes.
Json list_targets(const rigs::MachineKind& kind) {
  Json targets = Json::array();
  const auto add = [&targets](const rigs::Column& column, bool is_needed) {
    targets.push_back({{"name", column.quantity.header()},
                       {"unit", column.quantity.file_unit().symbol},
                       {"doc", column.doc},
                       {"is_needed", is_needed}});
  };
  for (const rigs::Column& column : kind.columns.given) add(column, true);
  for (const rigs::Column& column : kind.columns.optional_given) add(column, false);
  for (const rigs::Column& column : kind.columns.measured) {
    add(column, column.quantity.header() == kind.traits.force.header());
  }
  return targets;
}

const rigs::MachineKind& find_kind(const GuessOptions& options) {
  if (!options.vehicle.empty()) return rigs::find_kind_without_rig(&models::is_any);
  return *rigs::read_rig(read_config(find_asset("rigs", options.rig))).kind;
}

Json make_columns(const measurements::Guess& guess) {
  return make_list(guess.columns, [](const measurements::GuessedColumn& column) {
    Json json{
        {"target", column.target.header()}, {"heading", column.heading}, {"reason", speak_of_page(column.reason)}};
    if (column.value.has_value()) {
      json["value"] = *column.value;
    } else {
      json["unit"] = column.unit.written;
      json["is_negative"] = column.sign < 0.0;
    }
    return json;
  });
}

}  // namespace

std::vector<DroppedFile> list_dropped_files(const std::string& folder) {
  std::vector<DroppedFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const bool is_toml = entry.path().extension() == ".toml";
    files.push_back({fs::relative(entry.path(), folder).string(),
                     is_toml ? find_toml_kind(entry.path().string()) : "log", entry.file_size()});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

Json guess_columns_json(const GuessOptions& options, const std::string& private_part) {
  Json json = Json::object();
  try {
    json["headings"] = list_headings(options.folder);
    if (!options.rig.empty() || !options.vehicle.empty()) json["targets"] = list_targets(find_kind(options));
    const measurements::Guess guess = measurements::guess_logs(options);
    json["columns"] = make_columns(guess);
    json["time"] = {{"heading", guess.time.heading}, {"reason", speak_of_page(guess.time.reason)}};
    json["guesses"] = make_list(measurements::list_guesses(guess), [](const measurements::GuessLine& line) {
      return Json{{"subject", line.subject}, {"taken", line.taken}, {"reason", speak_of_page(line.reason)}};
    });
  } catch (const InputError&) {
    json["problem"] = make_error_json(std::current_exception(), private_part);
  }
  return json;
}

}  // namespace rollrig::serve
