#include "api/campaign_definition.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "api/data.h"
#include "api/run_items.h"
#include "campaigns/items.h"
#include "rollrig/version.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kCampaignFormat = "rollrig-item-campaign/1";
constexpr const char* kFirstCampaignFormat = "rollrig-campaign/1";  // now of a plan alone; still read

/// The members of RunInput by the keys of campaign.json.
template <class Run, class Visit>
void visit_run(Run& run, const Visit& visit) {
  visit("scenario", run.scenario_or_file);
  visit("tire", run.tire);
  visit("rig", run.rig);
  visit("vehicle", run.vehicle);
  visit("fidelity", run.fidelity);
  visit("baseline", run.baseline);
  visit("sensors", run.sensors);
  visit("set", run.settings);
}

Json write_factor(const campaigns::Factor& factor) {
  Json json{{"key", factor.key}};
  switch (factor.kind) {
    case campaigns::Factor::Kind::kValues:
      json["values"] = factor.values;
      break;
    case campaigns::Factor::Kind::kUniform:
      json["uniform"] = {factor.first, factor.second};
      break;
    case campaigns::Factor::Kind::kNormal:
      json["normal"] = {factor.first, factor.second};
      break;
  }
  return json;
}

campaigns::Factor read_factor(const Json& json) {
  campaigns::Factor factor{json.at("key").get<std::string>()};
  if (json.contains("values")) {
    factor.values = json["values"].get<std::vector<std::string>>();
    return factor;
  }
  const bool is_uniform = json.contains("uniform");
  const Json& numbers = json.at(is_uniform ? "uniform" : "normal");
  factor.kind = is_uniform ? campaigns::Factor::Kind::kUniform : campaigns::Factor::Kind::kNormal;
  factor.first = numbers.at(0).get<double>();
  factor.second = numbers.at(1).get<double>();
  return factor;
}

Json write_diagnosis(const DiagnosisCampaignInput& input) {
  Json json{{"sets", input.sets}, {"smallest_effect_percent", input.smallest_effect_percent}};
  if (!input.only.empty()) json["only"] = input.only;
  if (!input.without.empty()) json["without"] = input.without;
  if (input.bad_rows == BadRows::kLeaveOut) json["skip_bad_rows"] = true;
  return json;
}

DiagnosisCampaignInput read_diagnosis(const Json& json) {
  DiagnosisCampaignInput input;
  input.sets = json.at("sets").get<std::vector<std::string>>();
  input.smallest_effect_percent = json.at("smallest_effect_percent").get<double>();
  input.only = json.value("only", std::vector<std::string>());
  input.without = json.value("without", std::vector<std::string>());
  if (json.value("skip_bad_rows", false)) input.bad_rows = BadRows::kLeaveOut;
  return input;
}

/// Numbers of a file that stand beside their standard uncertainty, as factors.
void add_uncertain(const ConfigTable& table, const std::string& prefix, std::vector<campaigns::Factor>& factors) {
  for (const auto& [key, value] : table.entries) {
    if (const ConfigTable* inner = value.as_table()) add_uncertain(*inner, prefix + key + ".", factors);
    const double* mean = std::get_if<double>(&value.data);
    const ConfigValue* beside = table.find(key + "_sd");
    const double* sd = beside != nullptr ? std::get_if<double>(&beside->data) : nullptr;
    if (mean == nullptr || sd == nullptr || !(*sd > 0.0)) continue;
    factors.push_back({prefix + key, campaigns::Factor::Kind::kNormal, {}, *mean, *sd});
  }
}

/// The columns of a list. Throws InputError; none where `path` is empty.
std::vector<campaigns::Factor> read_list(const std::string& path) {
  std::vector<campaigns::Factor> factors;
  if (path.empty()) return factors;
  const CsvTable table = CsvTable::read(path);
  for (const std::string& column : table.columns()) {
    factors.push_back({boost::algorithm::trim_copy(column), campaigns::Factor::Kind::kValues, table.text(column)});
    for (std::string& value : factors.back().values) boost::algorithm::trim(value);
    const auto empty = std::find(factors.back().values.begin(), factors.back().values.end(), "");
    if (empty == factors.back().values.end()) continue;
    throw table.cell_error(static_cast<std::size_t>(empty - factors.back().values.begin()), column,
                           "a setting without a value", "a value in each row");
  }
  return factors;
}

std::vector<campaigns::Factor> list_factors(const RunCampaignInput& input, const scenarios::RunSpec& spec) {
  std::vector<campaigns::Factor> factors = read_list(input.list);
  for (const SweepAxis& axis : input.axes) factors.push_back({axis.key, campaigns::Factor::Kind::kValues, axis.values});
  for (const std::string& text : input.drawn) factors.push_back(campaigns::read_drawn_factor(text));
  for (const std::string& name : input.drawn_sd) {
    const std::vector<std::string> known{"tire", "rig", "vehicle"};
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      InputProblem problem = unknown_name("file", name, known);
      problem.file = "command line";
      problem.key = "--draw-sd";
      throw InputError(problem);
    }
    const bool has_file = name == "tire" || (name == "rig" ? spec.scenario->has_rig() : spec.vehicle.has_value());
    const std::size_t before = factors.size();
    if (has_file) {
      const std::string& content = name == "tire"  ? spec.tire.content
                                   : name == "rig" ? spec.rig.content
                                                   : spec.vehicle->content;
      add_uncertain(parse_config(content, name), name + ".", factors);
    }
    if (factors.size() > before) continue;
    throw InputError({fmt::format("the runs have no {} with an uncertainty", name), "command line", 0, "--draw-sd",
                      name, "a file with numbers that have an _sd beside them", ""});
  }
  return factors;
}

/// The index of a factor; how many there are where it is none.
std::size_t find_factor(const std::vector<campaigns::Factor>& factors, const std::string& key) {
  const auto has_key = [&key](const campaigns::Factor& factor) { return factor.key == key; };
  return static_cast<std::size_t>(std::find_if(factors.begin(), factors.end(), has_key) - factors.begin());
}

/// Pairs of factors of --draw-sd, which begin at `first_sd`, whose errors the tire file says to be correlated.
std::vector<campaigns::FactorPair> list_correlated(const std::vector<campaigns::Factor>& factors, std::size_t first_sd,
                                                   const scenarios::RunSpec& spec) {
  std::vector<campaigns::FactorPair> pairs;
  const std::string rig = spec.scenario->has_rig() ? spec.rig.thermal_name() : "";
  for (const models::CorrelatedPair& pair : models::list_correlated_pairs(spec.tire, rig)) {
    const std::size_t first = find_factor(factors, pair.first);
    const std::size_t second = find_factor(factors, pair.second);
    const bool are_drawn = std::min(first, second) >= first_sd && std::max(first, second) < factors.size();
    if (are_drawn) pairs.push_back({first, second, pair.correlation});
  }
  return pairs;
}

/// Makes a value absolute that is the path of a file, such as the speed trace of follow_drum.
void make_absolute_if_file(std::string& value) {
  std::error_code none;
  if (!parse_number(value).has_value() && fs::is_regular_file(value, none)) value = fs::absolute(value).string();
}

/// "key=value" likewise.
void make_setting_absolute(std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) return;
  std::string value = setting.substr(equals + 1);
  make_absolute_if_file(value);
  setting = setting.substr(0, equals + 1) + value;
}

/// Throws InputError where a factor is given in another way, too.
void require_given_once(const RunCampaignInput& input, const std::vector<campaigns::Factor>& factors) {
  ConfigTable file;
  if (is_file_name(input.run.scenario_or_file)) file = read_config(input.run.scenario_or_file);
  const auto is_overridden = [&file](const std::string& key) {
    std::vector<std::string> parts;
    boost::algorithm::split(parts, "override." + key, [](char c) { return c == '.'; });
    const ConfigTable* table = &file;
    for (const std::string& part : parts) {
      const ConfigValue* value = table != nullptr ? table->find(part) : nullptr;
      if (value == nullptr) return false;
      table = value->as_table();
    }
    return true;
  };
  for (const campaigns::Factor& factor : factors) {
    const auto sets = [&](const std::string& setting) {  // it, or a table that holds it
      const std::string key = setting.substr(0, setting.find('='));
      return key == factor.key || factor.key.rfind(key + ".", 0) == 0;
    };
    if (std::any_of(input.run.settings.begin(), input.run.settings.end(), sets)) {
      throw InputError({fmt::format("'{}' is both a factor and given by --set", factor.key), "command line", 0, "--set",
                        factor.key, "either --set or the factor", ""});
    }
    if (!is_overridden(factor.key)) continue;
    throw InputError({fmt::format("'{}' is both a factor and given by the run file", factor.key),
                      input.run.scenario_or_file, 0, "[override]", factor.key, "either the run file or the factor",
                      ""});
  }
}

}  // namespace

std::vector<std::string> campaign_designs() { return campaigns::design_names(); }

std::string CampaignDefinition::to_text() const {
  Json json{{"format", kCampaignFormat}, {"rollrig", version}};
  if (!sources.empty()) json["sources"] = sources;
  if (diagnosis.has_value()) {
    json["diagnosis"] = write_diagnosis(*diagnosis);
  } else {
    json["run"] = Json::object();
    visit_run(run, [&json](const char* key, const auto& value) {
      if (!value.empty()) json["run"][key] = value;
    });
  }
  json["files"] = Json::array();
  for (const CampaignFile& file : files) json["files"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  if (diagnosis.has_value()) return rollrig::to_text(json) + "\n";
  json["design"] = design.name;
  if (design.points > 0) json["points"] = design.points;
  json["seed"] = design.seed;
  json["factors"] = make_list(design.factors, &write_factor);
  for (const campaigns::FactorPair& pair : design.correlated) {
    json["correlated"].push_back({{"factors", {design.factors[pair.first].key, design.factors[pair.second].key}},
                                  {"correlation", pair.correlation}});
  }
  return rollrig::to_text(json) + "\n";
}

namespace {

std::size_t read_count(const Json& json, const char* key, const std::string& path) {
  const Json& value = json.at(key);
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  throw InputError(
      {fmt::format("'{}' is no whole number", key), path, 0, key, value.dump(), "a whole number, >= 0", ""});
}

}  // namespace

CampaignDefinition CampaignDefinition::read(const std::string& content, const std::string& path) {
  const Json json = parse_json(content, path);
  if (!json.is_object() || !json.contains("format")) {
    throw InputError({"this is no file of a campaign", path, 0, "format", "", "what rollrig campaign new writes", ""});
  }
  CampaignDefinition definition;
  try {
    if (json.at("format") != kCampaignFormat && json.at("format") != kFirstCampaignFormat) {
      throw InputError({"this is no campaign of this version of rollrig", path, 0, "format", json.at("format").dump(),
                        kCampaignFormat, ""});
    }
    definition.version = json.at("rollrig").get<std::string>();
    definition.sources = json.value("sources", "");
    for (const Json& file : json.at("files")) definition.files.push_back({file.at("path"), file.at("sha256")});
    if (json.contains("diagnosis")) {
      definition.diagnosis = read_diagnosis(json["diagnosis"]);
      if (!definition.files.empty() && !definition.diagnosis->sets.empty()) return definition;
      throw InputError({"the file of the campaign says no sets or no files", path, 0, "diagnosis", "",
                        "what rollrig campaign new writes", ""});
    }
    visit_run(definition.run, [&json](const char* key, auto& value) {
      const auto found = json.at("run").find(key);
      if (found != json.at("run").end()) found->get_to(value);
    });
    if (json.at("files").empty() || definition.run.scenario_or_file.empty()) {
      throw InputError({"the file of the campaign says no scenario or no files", path, 0, "files", "",
                        "what rollrig campaign new writes", ""});
    }
    definition.design.name = json.at("design").get<std::string>();
    definition.design.points = json.contains("points") ? read_count(json, "points", path) : 0;
    definition.design.seed = read_count(json, "seed", path);
    for (const Json& factor : json.at("factors")) definition.design.factors.push_back(read_factor(factor));
    for (const Json& pair : json.value("correlated", Json::array())) {
      const auto find = [&](std::size_t place) {
        const std::string key = pair.at("factors").at(place).get<std::string>();
        const std::size_t factor = find_factor(definition.design.factors, key);
        if (factor < definition.design.factors.size()) return factor;
        throw InputError({fmt::format("'{}' is correlated and no factor", key), path, 0, "correlated", key,
                          "the key of a factor", ""});
      };
      definition.design.correlated.push_back({find(0), find(1), pair.at("correlation").get<double>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError({fmt::format("the file of the campaign was changed or is damaged: {}", error.what()), path, 0, "",
                      "", "what rollrig campaign new writes", ""});
  }
  return definition;
}

namespace {

/// A list says all that differs.
void require_list_alone(const RunCampaignInput& input) {
  const bool has_others = !input.axes.empty() || !input.drawn.empty() || !input.drawn_sd.empty();
  const bool has_other_design = !input.design.empty() && input.design != campaigns::kList;
  if (input.list.empty() || (!has_others && !has_other_design)) return;
  throw InputError({"a list says all that differs between the items", "command line", 0, "--list", input.list,
                    has_others ? "--list without --vary and --draw" : "--list with --design list, or without --design",
                    ""});
}

}  // namespace

namespace {

/// The tires of a campaign with a factor "tire"; empty where all items have one tire.
std::vector<std::string> list_tire_values(const RunCampaignInput& input) {
  for (const SweepAxis& axis : input.axes) {
    if (axis.key == kTireFactor) return axis.values;
  }
  for (const campaigns::Factor& factor : read_list(input.list)) {
    if (factor.key == kTireFactor) return factor.values;
  }
  return {};
}

void require_tire_once(const RunCampaignInput& input, const std::vector<std::string>& tires) {
  if (tires.empty()) return;
  if (!input.run.tire.empty()) {
    throw InputError({"the tire is a factor and given by --tire", "command line", 0, "--tire", input.run.tire,
                      "either --tire or the factor", ""});
  }
  if (std::find(input.drawn_sd.begin(), input.drawn_sd.end(), "tire") == input.drawn_sd.end()) return;
  throw InputError({"numbers of one tire cannot be drawn where the tire varies", "command line", 0, "--draw-sd", "tire",
                    "either --draw-sd tire or the factor", ""});
}

}  // namespace

CampaignDefinition make_definition(const RunCampaignInput& input) {
  require_list_alone(input);
  CampaignDefinition definition;
  definition.version = library_version();
  definition.sources = library_sources();
  definition.run = input.run;
  definition.run.seed.clear();
  definition.list = input.list;
  for (std::string* name : {&definition.run.scenario_or_file, &definition.run.tire, &definition.run.rig,
                            &definition.run.vehicle, &definition.run.sensors}) {
    *name = absolute_if_path(*name);
  }
  for (std::string& setting : definition.run.settings) make_setting_absolute(setting);
  const std::vector<std::string> tires = list_tire_values(input);
  require_tire_once(input, tires);
  RunInput first = input.run;
  if (!tires.empty()) first.tire = tires.front();
  const scenarios::RunSpec spec = read_run(first);
  // Assets by their paths: their names may stand for other files where and when an item is carried out.
  if (tires.empty()) definition.run.tire = fs::absolute(spec.tire.path).string();
  if (spec.scenario->has_rig()) definition.run.rig = fs::absolute(spec.rig.path).string();
  if (spec.vehicle.has_value()) definition.run.vehicle = fs::absolute(spec.vehicle->path).string();
  campaigns::DesignInput& design = definition.design;
  const bool is_drawn = !input.drawn.empty() || !input.drawn_sd.empty();
  design.name = !input.design.empty() ? input.design
                : is_drawn            ? campaigns::kMonteCarlo
                : input.list.empty()  ? campaigns::kGrid
                                      : campaigns::kList;
  design.factors = list_factors(input, spec);
  for (campaigns::Factor& factor : design.factors) {
    for (std::string& value : factor.values) {
      if (factor.key == kTireFactor) {
        value = absolute_if_path(value);  // a name stays: results show it, and its file's hash is in the definition
      } else {
        make_absolute_if_file(value);
      }
    }
  }
  design.correlated = list_correlated(design.factors, input.axes.size() + input.drawn.size(), spec);
  design.points = input.points;
  design.seed = spec.seed;
  require_given_once(input, design.factors);
  return definition;
}

CampaignDefinition make_definition(const DiagnosisCampaignInput& input) {
  CampaignDefinition definition;
  definition.version = library_version();
  definition.sources = library_sources();
  definition.diagnosis = input;
  for (std::string& set : definition.diagnosis->sets) {
    set = fs::absolute(set).lexically_normal().string();
    require_file((fs::path(set) / "set.toml").string());  // also that its name is UTF-8 text, as campaign.json needs it
  }
  return definition;
}

void require_same_program(const CampaignDefinition& definition, const std::string& path) {
  if (definition.version == library_version()) {
    if (definition.sources == library_sources()) return;
    throw InputError(
        {fmt::format("the campaign was begun with other sources of rollrig {}; its results could differ "
                     "from those of this program",
                     definition.version),
         path, 0, "sources", definition.sources,
         fmt::format("the program whose sources have this hash, or a new campaign; those of this program have {}",
                     library_sources()),
         ""});
  }
  throw InputError({fmt::format("the campaign was begun with rollrig {}; its results could differ from those of "
                                "rollrig {}",
                                definition.version, library_version()),
                    path, 0, "rollrig", definition.version, "the same version, or a new campaign", ""});
}

namespace {

void require_same(const CampaignFile& file) {
  if (calc_sha256(read_binary_file(file.path)) == file.sha256) return;
  throw campaigns::CampaignChanged({"the file has changed since the campaign was begun", file.path, 0, "", "",
                                    "the file as it was, or a new campaign", ""});
}

}  // namespace

FileWatch::FileWatch(const std::vector<CampaignFile>& files) {
  for (const CampaignFile& file : files) {
    require_file(file.path);
    known_[file.path] = {file, fs::last_write_time(file.path), fs::file_size(file.path)};  // before it is read
    require_same(file);
  }
}

void FileWatch::require_known(const std::vector<std::string>& paths) const {
  for (const std::string& path : paths) {
    if (knows(path)) continue;
    throw campaigns::CampaignChanged({"the campaign would read a file that it did not read when it was begun", path, 0,
                                      "", "", "the files of campaign.json; or a new campaign", ""});
  }
}

bool FileWatch::knows(const std::string& path) const { return known_.count(path) > 0; }

void FileWatch::require_unchanged(const Known& known) {
  std::error_code error;
  const bool is_same_time = fs::last_write_time(known.file.path, error) == known.time && !error;
  if (is_same_time && fs::file_size(known.file.path, error) == known.size && !error) return;
  require_file(known.file.path);
  require_same(known.file);
}

void FileWatch::require_unchanged() const {
  for (const auto& [path, known] : known_) require_unchanged(known);
}

void FileWatch::require_unchanged(const std::vector<std::string>& paths) const {
  for (const std::string& path : paths) {
    const auto known = known_.find(path);
    if (known != known_.end()) require_unchanged(known->second);
  }
}

}  // namespace rollrig
