/// stress_numbers: runs with numbers at, within and beyond their limits, singly, in pairs and more. Each is refused,
/// fails with a reason, or gives finite results, within 20 s of CPU time.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>

#include "build_paths.h"
#include "models/effect.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/core/config.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/watched_child.h"

using namespace rollrig;
using namespace rollrig::fuzz;

namespace {

constexpr unsigned kMostTime_s = 20;
constexpr std::size_t kMostMemory_B = 5UL << 29;  // Assumed: 2.5 GiB of address space, a fifth of it for libraries

using Numbers = std::vector<double>;

/// The numbers of a text such as ">= 100 and <= 100000".
Numbers find_numbers(const std::string& text) {
  Numbers numbers;
  for (std::size_t at = 0; (at = text.find_first_of("-0123456789", at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_not_of("-+.e0123456789", at), text.size());
    if (const auto number = parse_number(text.substr(at, end - at))) numbers.push_back(*number);
    at = end;
  }
  return numbers;
}

/// What may be given as key=value, and numbers about which something may change: its limits and its usual value.
struct Key {
  std::string name;
  Numbers about;
};

void add_numbers_of(const ConfigTable& table, const std::string& prefix, std::vector<Key>& keys) {
  for (const auto& [name, value] : table.entries) {
    if (const ConfigTable* below = value.as_table()) {
      add_numbers_of(*below, prefix + name + ".", keys);
    } else if (const double* number = std::get_if<double>(&value.data)) {
      keys.push_back({prefix + name, {*number}});
    }
  }
}

struct Subject {
  std::string scenario;
  std::map<std::string, std::string> names;  // of tire, rig, vehicle
  std::vector<Key> keys;
};

/// Numbers of the files that the subject names, and of all effects.
void add_keys(Subject& subject) {
  for (const auto& [kind, name] : subject.names) {
    add_numbers_of(read_config(find_asset(kind + "s", name)), kind + ".", subject.keys);
  }
  for (const models::Effect* effect : models::all_effects()) {
    for (const models::EffectParameter& parameter : effect->info.parameters) {
      Numbers about = find_numbers(parameter.range.to_string());
      if (parameter.off.has_value()) about.push_back(*parameter.off);
      subject.keys.push_back({fmt::format("effects.{}.{}", effect->info.id, parameter.key), about});
    }
  }
}

/// Scenarios that need no file of their own, with the assets that they run on.
std::vector<Subject> list_subjects() {
  std::vector<Subject> subjects;
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    if (scenario->text.name.rfind("follow_", 0) == 0) continue;
    Subject subject{scenario->text.name, {{"tire", "a50"}}, {}};
    if (scenario->has_rig()) subject.names["rig"] = scenario->default_rig;
    if (scenario->has_vehicle) subject.names["vehicle"] = "source_car";
    for (const scenarios::SettingInfo& setting : scenario->settings) {
      Numbers about = find_numbers(setting.range);
      const Numbers usual = find_numbers(setting.fallback);
      about.insert(about.end(), usual.begin(), usual.end());
      subject.keys.push_back({setting.key, about});
    }
    add_keys(subject);
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

std::string draw_value(const Key& key, Engine& engine) {
  static const std::vector<std::string> extremes{"0",   "-0.0", "1e-300", "-1e-300", "1e308", "-1e308", "nan",
                                                 "inf", "-inf", "1e999",  "-1",      "1e-9",  "1e9",    "5e-324"};
  if (key.about.empty() || engine() % 8 == 0) return extremes[engine() % extremes.size()];
  const double about = key.about[engine() % key.about.size()];
  static const Numbers factors{1.0, 1.0, 1.0 + 1e-9, 1.0 - 1e-9, 0.5, 2.0, 0.1, 10.0, 1e-3, 1e3, -1.0};
  return fmt::format("{:.17g}", about * factors[engine() % factors.size()]);
}

/// A run as lines: the scenario, the fidelity, then key=value.
std::string draw_run(const std::vector<Subject>& subjects, Engine& engine) {
  const Subject& subject = subjects[engine() % subjects.size()];
  // These take longer than the limit as they are, with the fidelity multibody.
  const bool is_long = subject.scenario == "sae_j1634" || subject.scenario == "dyno_setting";
  const bool is_multibody = engine() % 10 == 0 && !is_long;
  std::string lines = subject.scenario + "\n" + (is_multibody ? "multibody" : "quasi_static") + "\n";
  const std::size_t count = 1 + static_cast<std::size_t>(engine() % 4);
  for (std::size_t i = 0; i < count; ++i) {
    const Key& key = subject.keys[engine() % subject.keys.size()];
    lines += fmt::format("{}={}\n", key.name, draw_value(key, engine));
  }
  return lines;
}

void require_finite(const Json& json, const std::string& key) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) {
    throw std::runtime_error(fmt::format("the result {} is {}", key, json.get<double>()));
  }
  if (!json.is_structured()) return;
  for (const auto& [name, below] : json.items()) require_finite(below, key + "." + name);
}

enum End : std::size_t { kRefused, kFailed, kDone };
constexpr const char* kEndNames[] = {"refused", "failed with a reason", "done"};

End carry_out(const std::string& lines) {
  std::vector<std::string> words;
  boost::algorithm::split(words, lines, boost::algorithm::is_any_of("\n"));
  words.pop_back();  // after the last line's end
  try {
    ConfigTable document = scenarios::make_run_document(words.at(0));
    const scenarios::Scenario& scenario = scenarios::find_scenario(words.at(0));
    set_config_value(document, "tire", "a50", "stress");
    if (scenario.fidelities.size() > 1) set_config_value(document, "fidelity", words.at(1), "stress");
    for (std::size_t i = 2; i < words.size(); ++i) scenarios::set_run_value(document, words[i]);
    const scenarios::RunSpec spec = scenarios::read_run_spec(document, ".");
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    require_finite(outcome.result, "result");
    require_finite(scenarios::make_result_json(spec, outcome), "");
    return kDone;
  } catch (const InputError&) {
    return kRefused;
  } catch (const RunFailure&) {
    return kFailed;
  }
}

/// Carries out one run in the child, within its limits.
End give(const std::string& run, Watched& watched) {
  watched.begin(run, kMostTime_s);
  const End end = carry_out(run);
  watched.end(end);
  return end;
}

struct Options {
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  std::string repeat;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs with numbers at, within and beyond their limits"};
  Options options;
  app.add_option("--runs", options.runs, "How many [1000]");
  app.add_option("--seed", options.seed, "Decides all numbers [1]");
  app.add_option("--repeat", options.repeat, "One run alone, as it was printed, with \\n between its lines");
  CLI11_PARSE(app, argc, argv);
  spdlog::set_level(spdlog::level::off);
  if (!options.repeat.empty()) {
    std::string lines = options.repeat;
    for (std::size_t at = 0; (at = lines.find("\\n", at)) != std::string::npos;) lines.replace(at, 2, "\n");
    Watched watched;
    const std::string ended =
        watched.run([&] { std::cout << kEndNames[give(lines, watched)] << std::endl; }, kMostMemory_B);
    if (ended.empty()) return 0;
    std::cout << ended << "\n";
    return 1;
  }
  const std::vector<Subject> subjects = list_subjects();
  Engine engine(options.seed);
  Watched watched;
  std::size_t wrong = 0;
  for (std::size_t begun = 0; begun < options.runs;) {
    // A child that ends is replaced; the engine's state goes on in the parent by what the child has drawn.
    const Engine at_start = engine;
    const std::size_t before = watched.executions();
    const std::string ended = watched.run(
        [&] {
          for (std::size_t i = begun; i < options.runs; ++i) {
            const std::string run = draw_run(subjects, engine);
            give(run, watched);
          }
        },
        kMostMemory_B);
    const std::size_t done = watched.executions() - before + (ended.empty() ? 0 : 1);
    engine = at_start;
    for (std::size_t i = 0; i < done; ++i) draw_run(subjects, engine);
    begun += done;
    if (ended.empty()) continue;
    ++wrong;
    std::string shown = watched.last_input();
    for (std::size_t at = 0; (at = shown.find('\n', at)) != std::string::npos;) shown.replace(at, 1, "\\n");
    std::cout << fmt::format("{}: {}\n", ended, shown) << std::flush;
  }
  const std::size_t done = watched.executions_with(kDone);
  std::cout << fmt::format("{} runs: {} done, {} failed with a reason, {} refused, {} defects\n", options.runs, done,
                           watched.executions_with(kFailed), watched.executions_with(kRefused), wrong);
  if (done == 0) std::cout << "No run was done: this is a defect too.\n";
  return wrong == 0 && done > 0 ? 0 : 1;
}
