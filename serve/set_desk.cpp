#include "serve/set_desk.h"

#include <algorithm>
#include <filesystem>

#include "api/data.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/output/diagnosis_json.h"
#include "report/diagnosis_page.h"
#include "report/page.h"
#include "rollrig/measurement_set.h"
#include "rollrig/scaffold.h"
#include "serve/dropped_files.h"
#include "serve/live_run.h"
#include "serve/page_words.h"
#include "sim/core/error.h"

namespace fs = std::filesystem;

namespace rollrig::serve {
namespace {

constexpr std::size_t kMostSets = 8;  // Assumed: one person, who looks at one after the other

std::map<std::string, std::string> texts_of(const Json& request, const char* key) {
  std::map<std::string, std::string> texts;
  for (const auto& [name, value] : object_of(request, key).items()) {
    if (!value.is_string()) throw Refusal(400, fmt::format("'{}' holds texts", key));
    if (!value.get<std::string>().empty()) texts[name] = value.get<std::string>();
  }
  return texts;
}

std::map<std::string, double> numbers_of(const Json& request, const char* key) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : object_of(request, key).items()) {
    if (!value.is_number()) throw Refusal(400, fmt::format("'{}' holds numbers", key));
    numbers[name] = value.get<double>();
  }
  return numbers;
}

Json make_lead(const diagnosis::Diagnosis& found) {
  constexpr const char* kNames[] = {"no_gap", "explained", "unexplained"};
  Json causes = Json::array();
  for (const Cause& cause : found.causes) {
    causes.push_back({{"effects", cause.effects}, {"probability", cause.probability}});
  }
  return {{"verdict", kNames[static_cast<int>(found.verdict)]}, {"causes", causes}};
}

}  // namespace

SetDesk::SetDesk(const Shelf& shelf, KeptPages& kept, Jobs& jobs, int threads)
    : shelf_(shelf), kept_(kept), jobs_(jobs), threads_(threads) {}

SetDesk::DroppedSet SetDesk::copy_of(int id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto at = sets_.find(id);
  if (at == sets_.end()) throw Refusal(404, "there is no such set; drop it again");
  return at->second;
}

Json SetDesk::open(const Json& request) {
  std::string name = text_of(request, "name");
  constexpr std::size_t kLongestName = 100;
  if (name.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // not inside of a character
    name.resize(end);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (sets_.size() >= kMostSets) {
    std::error_code ignored;
    fs::remove_all(fs::path(logs_of(sets_.begin()->first)).parent_path(), ignored);
    sets_.erase(sets_.begin());
  }
  const int id = next_++;
  sets_[id].name = name.empty() ? "dropped" : name;
  fs::create_directories(logs_of(id));
  return {{"set", id}, {"name", sets_[id].name}};
}

std::unique_ptr<IncomingFile> SetDesk::take_file(int id, const std::string& name, std::uint64_t bytes) {
  require_file_name(name);
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto at = sets_.find(id);
  if (at == sets_.end()) throw Refusal(404, "there is no such set; drop it again");
  DroppedSet& set = at->second;
  if (set.files >= kMostSetFiles) throw Refusal(413, fmt::format("at most {} files are taken", kMostSetFiles));
  if (set.bytes + bytes > kMostSet_bytes) {
    throw Refusal(413, fmt::format("a set of more than {} MiB is not taken", kMostSet_bytes >> 20));
  }
  auto file = std::make_unique<IncomingFile>(logs_of(id), name);
  ++set.files;
  set.bytes += bytes;
  return file;
}

DroppedKind SetDesk::find_kind(int id) const {
  if (fs::exists(logs_of(id) + "/set.toml")) return DroppedKind::kSet;
  return fs::exists(logs_of(id) + "/import.toml") ? DroppedKind::kMapping : DroppedKind::kLogs;
}

/// A file that was dropped beside the logs, else what the shelf has.
std::string SetDesk::find_asset(int id, const char* kind, const std::string& name) const {
  if (name.empty()) return "";
  for (const DroppedFile& file : list_dropped_files(logs_of(id))) {
    if (file.kind == kind && file.name == name) return logs_of(id) + "/" + name;
  }
  return shelf_.find(kind, name);
}

GuessOptions SetDesk::read_options(int id, const Json& request) const {
  if (!request.is_object()) throw Refusal(400, "the request is not a JSON object");
  GuessOptions options;
  options.folder = logs_of(id);
  options.tire = find_asset(id, "tire", text_of(request, "tire"));
  options.rig = find_asset(id, "rig", text_of(request, "rig"));
  options.vehicle = find_asset(id, "vehicle", text_of(request, "vehicle"));
  options.sensors = find_asset(id, "sensors", text_of(request, "sensors"));
  const std::string name = text_of(request, "name");
  options.name = name.empty() ? copy_of(id).name : name;
  options.columns = texts_of(request, "columns");
  options.units = texts_of(request, "units");
  options.values = numbers_of(request, "values");
  options.date_order = text_of(request, "date_order");
  options.rests_min = numbers_of(request, "rests_min");
  const auto cold = request.find("cold_pressure_kPa");
  if (cold != request.end() && !cold->is_null()) {
    if (!cold->is_number()) throw Refusal(400, "'cold_pressure_kPa' is not a number");
    options.cold_pressure_kPa = cold->get<double>();
  }
  return options;
}

Json SetDesk::guess(int id, const Json& request) {
  const DroppedSet set = copy_of(id);
  constexpr const char* kNames[] = {"set", "mapping", "logs"};
  const DroppedKind kind = find_kind(id);
  Json json{{"kind", kNames[static_cast<int>(kind)]}, {"name", set.name}};
  json["files"] = make_list(list_dropped_files(logs_of(id)), [](const DroppedFile& file) {
    return Json{{"name", file.name}, {"kind", file.kind}, {"bytes", file.bytes}};
  });
  if (kind == DroppedKind::kLogs) json.update(guess_columns_json(read_options(id, request), private_part(id)));
  return json;
}

Json SetDesk::make_set(int id, const Json& request) {
  copy_of(id);
  const DroppedKind kind = find_kind(id);
  std::string text;
  if (kind != DroppedKind::kSet) {
    const Report imported = kind == DroppedKind::kMapping ? import_logs(logs_of(id) + "/import.toml")
                                                          : import_guessed(read_options(id, request), made_of(id));
    write_folder(made_of(id), imported.make_files(), true);
    text = imported.text;
  }
  const FileCheck check = check_file(set_folder_of(id));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto at = sets_.find(id); at != sets_.end()) at->second.is_made = true;
  std::vector<std::string> warnings;
  for (const std::string& warning : check.warnings) warnings.push_back(speak_of_page(warning));
  return {{"what", check.what}, {"warnings", warnings}, {"is_good", check.is_good}, {"text", text}};
}

Json SetDesk::diagnose(int id, const Json& request) {
  const DroppedSet dropped = copy_of(id);
  if (!dropped.is_made) throw Refusal(409, "the set is not validated yet");
  DiagnosisOptions options;
  options.threads = threads_;
  for (const auto& [effect, wanted] : object_of(request, "only").items()) {
    if (wanted.is_boolean() && wanted.get<bool>()) options.only.push_back(effect);
  }
  // Read now: files may go before the job's turn comes.
  const MeasurementSet set(set_folder_of(id));
  const auto work = [this, set, options](const Progress& progress) {
    DiagnosisOptions how = options;
    how.progress = progress;
    const diagnosis::Diagnosis found = diagnosis::diagnose(set.data().set, how);
    const report::Page page = report::make_diagnosis_page(set.data().set, found);
    Json json = make_lead(found);
    json["kept"] = kept_.keep(set.name(), report::make_html(page));
    json["page"] = report::make_payload(page);
    return json;
  };
  return {{"job", jobs_.add(dropped.name, work)}};
}

}  // namespace rollrig::serve
