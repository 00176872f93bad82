// The source's open question (§5.2): is the parasitic loss that falls in the warm-up the rig's or the tire's?
#include <boost/scope_exit.hpp>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "diagnosis/diagnosis.h"
#include "diagnosis/output/diagnosis_json.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"
#include "tools/source_gap.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

namespace fs = std::filesystem;

measurements::MeasurementSet measure(const std::string& tire, const std::string& assignment) {
  const scenarios::RunSpec spec = make_spec("transient_skim", tire, {assignment}, {{"sensors", "source"}});
  std::string folder = (fs::temp_directory_path() / "rollrig-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  BOOST_SCOPE_EXIT_ALL(&) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  };
  for (const auto& [name, content] :
       scenarios::write_measurement_set(spec, scenarios::run_scenario(spec, {}), "transient")) {
    write_output((fs::path(folder) / name).string(), content);
  }
  return measurements::read_measurement_set(folder);
}

/// What is named, "or" between what cannot be told apart; else the verdict.
std::string find_named(const diagnosis::Diagnosis& found) {
  if (found.verdict != diagnosis::Verdict::kExplained) return diagnosis::name_of(found.verdict);
  const diagnosis::Cause& cause = found.causes.front();
  std::string text = fmt::format("`{}`", fmt::join(cause.effects, "` with `"));
  for (const std::string& id : cause.indistinguishable_from) text += " or `" + id + "`";
  return text;
}

}  // namespace

SkimAnswer ask(const std::string& tire, const std::string& effect, const std::string& parameter, double size) {
  const std::string key = effect + "." + parameter;
  const auto set = measure(tire, fmt::format("effects.{}={}", key, size));
  diagnosis::DiagnosisOptions options;
  options.threads = 1;
  const diagnosis::Diagnosis found = diagnosis::diagnose(set, options);
  return {tire,
          effect,
          size,
          unit_of_key(parameter).symbol,
          find_named(found),
          found.probability.at("bearing_warmup"),
          found.probability.at("tire_loss_in_skim"),
          found.next_tests.empty() ? "" : found.next_tests.front().test};
}

std::vector<SkimAnswer> ask_all() {
  struct Question {
    std::string tire;
    const char* effect;
    double of_range;  // 0 the prior's lower end, 1 its upper end
  };
  std::vector<Question> questions;
  for (const char* effect : {"bearing_warmup", "tire_loss_in_skim"}) {
    for (const std::string& tire : kTires) questions.push_back({tire, effect, 0.5});
    questions.push_back({"a50", effect, 0.0});
    questions.push_back({"a50", effect, 1.0});
  }
  std::vector<SkimAnswer> answers(questions.size());
  parallel_for(questions.size(), 0, [&](std::size_t i) {
    const models::EffectParameter& size = models::find_effect(questions[i].effect).info.parameters.front();
    const double value = questions[i].of_range == 0.0   ? size.prior.low
                         : questions[i].of_range == 1.0 ? size.prior.high
                                                        : size.prior.center();
    answers[i] = ask(questions[i].tire, questions[i].effect, size.key, value);
  });
  return answers;
}

Rows list_answers(const std::vector<SkimAnswer>& answers) {
  Rows rows;
  for (const SkimAnswer& one : answers) {
    rows.push_back(fmt::format("| {} | `{}` | {:.3g} {} | {} | {:.2f} | {:.2f} | {} |", one.tire, one.truth, one.size,
                               one.size_unit, one.named, one.bearing_warmup, one.tire_loss_in_skim, one.next_test));
  }
  return rows;
}

}  // namespace rollrig::tools
