#include "scenarios/run/settings.h"

#include <filesystem>

#include "sim/core/file_io.h"

namespace rollrig::scenarios {

void read_member(TableReader& reader, const Field& field, FilePath& member) {
  const std::string text = reader.text(field.key);
  const std::filesystem::path named_in = reader.source().find(field.key)->origin.file;
  member.path = (named_in.parent_path() / text).lexically_normal().string();
}

void read_member(TableReader& reader, const Field& field, Name& member) {
  const std::string old = reader.text_or(field.output_key(), member.value);
  member.value = reader.text_or(field.key, old);
}

std::string detail::show_default(const Json& value) {
  if (value.is_number()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string() && value != "") return value.get<std::string>();
  std::vector<std::string> items;
  for (const Json& item : value.is_array() ? value : Json::array()) items.push_back(show_default(item));
  return items.empty() ? "see text" : fmt::format("[{}]", fmt::join(items, ", "));
}

void detail::add_hash(const Field& field, const FilePath& member, Json& hashes) {
  hashes[std::string(field.key) + "_sha256"] = calc_sha256(read_text_file(member.path));
}

InputProblem setting_problem(const RunSpec& spec, const char* key, const std::string& what,
                             const std::string& allowed) {
  InputProblem problem{what, "", 0, key, "", allowed, ""};
  if (const ConfigValue* set = spec.settings.find(key)) {
    problem.file = set->origin.file;
    problem.line = set->origin.line;
    problem.value = set->text;
  }
  return problem;
}

}  // namespace rollrig::scenarios
