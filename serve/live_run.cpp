#include "serve/live_run.h"

#include <algorithm>
#include <chrono>

#include "report/page.h"
#include "report/run_page.h"
#include "scenarios/run/run_spec.h"
#include "serve/refusal.h"
#include "sim/core/error.h"

namespace rollrig::serve {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kLongestRun{60};  // Assumed: nobody waits longer before a slider
constexpr const char* kOrigin = "the page";

/// The value as TOML has it: a number, or a word that the setting declares.
std::string show_value(const scenarios::Scenario& scenario, const std::string& key, const Json& value) {
  if (value.is_number()) return fmt::format("{:.17g}", value.get<double>());
  if (!value.is_string()) throw Refusal(400, fmt::format("'{}' is neither a number nor a word", key));
  const auto word = value.get<std::string>();
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    const auto& choices = setting.choices;
    if (setting.key == key && std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  }
  throw Refusal(400, fmt::format("'{}' takes no such word", key));
}

void require_plain_key(const std::string& key) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (key.empty() || !std::all_of(key.begin(), key.end(), is_plain)) throw Refusal(400, "a key is a word");
}

ConfigTable make_document(const Json& request, const Shelf& shelf) {
  const std::string name = text_of(request, "scenario");
  const scenarios::Scenario& scenario = scenarios::find_scenario(name);
  if (!is_offered(scenario)) throw Refusal(400, fmt::format("scenario '{}' is not offered here", name));
  ConfigTable document = scenarios::make_run_document(scenario.text.name);
  const auto set = [&](const std::string& key, const std::string& value) {
    document.entries[key] = ConfigValue{value, {kOrigin, 0}, value};
  };
  set("fidelity", "quasi_static");
  for (const char* kind : {"tire", "rig", "vehicle"}) {
    const std::string chosen = text_of(request, kind);
    if (!chosen.empty()) set(kind, shelf.find(kind, chosen));
  }
  for (const auto& [key, value] : object_of(request, "settings").items()) {
    require_plain_key(key);
    set_config_value(document, "settings." + key, show_value(scenario, key, value), kOrigin);
  }
  for (const auto& [id, parameters] : object_of(request, "effects").items()) {
    require_plain_key(id);
    if (!parameters.is_object()) throw Refusal(400, "the parameters of an effect are an object");
    for (const auto& [key, value] : parameters.items()) {
      require_plain_key(key);
      if (!value.is_number()) throw Refusal(400, fmt::format("'{}' is not a number", key));
      set_config_value(document, fmt::format("effects.{}.{}", id, key), fmt::format("{:.17g}", value.get<double>()),
                       kOrigin);
    }
  }
  return document;
}

struct LiveRun {
  scenarios::RunSpec spec;
  scenarios::Outcome outcome;
};

/// Fills `run`, which stays where it is: the outcome refers to the spec.
void carry_out(const Json& request, const Shelf& shelf, LiveRun& run) {
  if (!request.is_object()) throw Refusal(400, "the request is not a JSON object");
  run.spec = scenarios::read_run_spec(make_document(request, shelf), "");
  const auto end = Clock::now() + kLongestRun;
  run.outcome = scenarios::run_scenario(run.spec, [end](double) {
    if (Clock::now() > end) throw RunFailure("the run takes longer than a minute: use rollrig run");
  });
}

/// Effects that change something on this machine with this tire.
Json list_acting(const scenarios::RunSpec& spec) {
  Json ids = Json::array();
  for (const models::Effect* effect : models::all_effects()) {
    if (models::acts_in(effect->info, spec.rig.kind->traits, spec.tire.model(spec.baseline)))
      ids.push_back(effect->info.id);
  }
  return ids;
}

double calc_ms(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

std::string text_of(const Json& request, const char* key) {
  const auto at = request.find(key);
  if (at == request.end() || at->is_null()) return "";
  if (!at->is_string()) throw Refusal(400, fmt::format("'{}' is not a text", key));
  return at->get<std::string>();
}

const Json& object_of(const Json& request, const char* key) {
  static const Json kEmpty = Json::object();
  const auto at = request.find(key);
  if (at == request.end() || at->is_null()) return kEmpty;
  if (!at->is_object()) throw Refusal(400, fmt::format("'{}' is not an object", key));
  return *at;
}

Json carry_out_live(const Json& request, const Shelf& shelf) {
  const auto start = Clock::now();
  LiveRun run;
  carry_out(request, shelf, run);
  const auto simulated = Clock::now();
  Json json{{"page", report::make_payload(report::make_run_page(run.spec, run.outcome))},
            {"settings", run.outcome.settings},
            {"effects", list_acting(run.spec)}};
  json["took_ms"] = {{"run", calc_ms(start, simulated)}, {"page", calc_ms(simulated, Clock::now())}};
  return json;
}

std::string make_live_page(const Json& request, const Shelf& shelf) {
  LiveRun run;
  carry_out(request, shelf, run);
  return report::make_html(report::make_run_page(run.spec, run.outcome));
}

}  // namespace rollrig::serve
