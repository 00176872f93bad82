#include "scenarios/run/settings.h"

#include <filesystem>

namespace rollrig::scenarios {

void read_member(TableReader& reader, const Field& field, FilePath& member) {
  const std::string text = reader.text(field.key);
  const std::filesystem::path named_in = reader.source().find(field.key)->origin.file;
  member.path = (named_in.parent_path() / text).lexically_normal().string();
}

InputProblem setting_problem(const RunSpec& spec, const char* key, const std::string& what,
                             const std::string& allowed) {
  InputProblem problem;
  problem.what = what;
  problem.key = key;
  problem.allowed = allowed;
  if (const ConfigValue* set = spec.settings.find(key)) {
    problem.file = set->origin.file;
    problem.line = set->origin.line;
    problem.value = set->text;
  }
  return problem;
}

}  // namespace rollrig::scenarios
