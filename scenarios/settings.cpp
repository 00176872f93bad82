#include "scenarios/settings.h"

namespace rollrig::scenarios {

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
