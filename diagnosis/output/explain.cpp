#include "diagnosis/output/explain.h"

#include <fmt/format.h>

#include "diagnosis/terms/machine_terms.h"
#include "rigs/machine.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

constexpr std::size_t kIndent = 2;

constexpr const char* kNone =
    "The simulation meets the measurement within the noise of the sensors once the numbers of tire and rig "
    "files move within their uncertainties (*_sd). Always in the comparison, with a probability of 42 % before "
    "the data speak. When it is the likeliest, the verdict is no_gap; the report then says which effects the "
    "set could not have shown.";

constexpr const char* kUnknown =
    "There is a gap, and no effect of the catalog, alone or together with one or two others, explains it. A flexible "
    "discrepancy stands in for what is not modeled: it takes part on top of the baseline and on top of each cause "
    "found. If it is at least as probable as the first cause, and more probable than none, the verdict is "
    "unexplained.";

constexpr const char* kUnknownNext =
    "Look at where the gap lies (channel, run, phase; which equation needs a perturbation), check sensors and units "
    "there, repeat that run, or add an effect (docs/add_an_effect.md).";

std::string join_or(const std::vector<std::string>& words, const char* none) {
  return words.empty() ? none : fmt::format("{}", fmt::join(words, ", "));
}

std::string section(const std::string& title, const std::string& text) { return title + "\n" + wrap(text, kIndent); }

/// What an effect's declaration says: of the catalog, or of those that only a second machine shows. nullptr where there
/// is no such effect.
const models::EffectInfo* find_info(const std::string& name) {
  if (const Term* term = look_up_term(name)) return &term->info();
  for (const models::Effect* effect : effects_between_machines()) {
    if (effect->info.id == name) return &effect->info;
  }
  return nullptr;
}

/// Each effect that it is confused with, with its own summary, so that one need not look it up.
std::string describe_confusions(const models::EffectInfo& info) {
  if (info.confused_with.empty()) return "  none known\n";
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : info.confused_with) {
    const models::EffectInfo* other = find_info(name);
    rows.push_back({name, other != nullptr ? other->summary : ""});
  }
  return text_columns(rows);
}

std::string describe_tests(const models::EffectInfo& info) {
  if (info.splitting_tests.empty()) return "  none needed\n";
  std::string text;
  for (const std::string& test : info.splitting_tests) text += wrap(test, kIndent);
  return text;
}

std::string describe_info(const models::EffectInfo& info) {
  std::string text = wrap(info.id + ": " + info.summary, 0);
  if (look_up_term(info.id) == nullptr) {
    text += section("Compared only by",
                    "rollrig diagnose A --against B (docs/machine_pairs.md): a single set cannot "
                    "show it");
  }
  text += section("Equation", info.equation) + section("Source", info.source);
  text += wrap(fmt::format("Own parameters ({}two thirds of the prior lie in the usual range)",
                           look_up_term(info.id) == nullptr ? "" : fmt::format("[effects.{}]; ", info.id)),
               0);
  std::vector<std::vector<std::string>> rows;
  for (const models::EffectParameter& each : info.parameters) rows.push_back({each.key, describe_parameter(each)});
  text += text_columns(rows);
  text += section("Acts on", join_or(rigs::list_machines(info.acts_on), "none"));
  if (info.only_against != nullptr)
    text += section("Acts only against", "the baseline constant_rrc: the combined one has it");
  const std::vector<std::string> faint = rigs::list_machines(info.faint_on);
  if (!faint.empty()) text += section("Too small to be seen on", join_or(faint, ""));
  text += section("Visible in", join_or(rigs::list_visible(info), "no measured channel"));
  text += section("Leaves unchanged", join_or(rigs::list_clean(info), "no measured channel"));
  text += "Confused with\n" + describe_confusions(info);
  return text + "Separated by\n" + describe_tests(info);
}

}  // namespace

std::string describe_parameter(const models::EffectParameter& parameter) {
  const models::Prior& prior = parameter.prior;
  const std::string unit = unit_of_key(parameter.key).symbol;
  std::string text =
      fmt::format("{}; usual {:.4g} to {:.4g}{}", parameter.doc, prior.low, prior.high, unit.empty() ? "" : " " + unit);
  text += fmt::format(", center {:.4g}", prior.center());
  if (prior.scale == models::Prior::Scale::kLog) text += ", on a log scale";
  if (prior.either_sign) text += ", either sign";
  text += fmt::format("; allowed {}", parameter.range.to_string());
  if (parameter.off.has_value()) text += fmt::format("; {:.4g} is off", *parameter.off);
  return text;
}

std::vector<std::string> explainable_names() {
  std::vector<std::string> names = term_names();
  for (const models::Effect* effect : effects_between_machines()) names.push_back(effect->info.id);
  names.insert(names.end(), {"none", "unknown"});
  return names;
}

std::string explain_effect(const std::string& name) {
  if (name == "none") return "none: no effect is needed\n" + wrap(kNone, kIndent);
  if (name == "unknown") {
    return "unknown: something outside the catalog\n" + wrap(kUnknown, kIndent) + section("Next", kUnknownNext);
  }
  if (const models::EffectInfo* info = find_info(name)) return describe_info(*info);
  InputProblem problem = unknown_name("effect", name, explainable_names());
  if (problem.nearest == "none") problem.nearest = nearest_name(name, models::effect_ids());  // near to any short word
  problem.file = "command line";
  problem.key = "--explain";
  throw InputError(problem);
}

}  // namespace rollrig::diagnosis
