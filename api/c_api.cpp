#include "rollrig/c_api.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "exports/wheel_of_tire.h"
#include "fmu/saved_state.h"
#include "rollrig/error.h"
#include "rollrig/run.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"
#include "sim/core/text.h"

struct rollrig_wheel {
  rollrig::fmu::WarmWheel wheel;
};

struct rollrig_run {
  std::string json;
  std::vector<rollrig::Channel> channels;  // time first
};

namespace rollrig {
namespace {

thread_local std::string last_error;

InputError c_error(const std::string& what, const std::string& key = "", const std::string& value = "",
                   const std::string& allowed = "") {
  return InputError({what, "", 0, key, value, allowed, ""});
}

/// Returns `status`, whose reason rollrig_last_error() tells.
int fail(int status, const char* why) noexcept {
  try {
    last_error = why;
  } catch (...) {  // out of memory: the status alone says it
  }
  return status;
}

/// Runs `body`, and keeps what it throws for rollrig_last_error().
template <class Body>
int run_c(Body&& body) noexcept {
  try {
    last_error.clear();
    body();
    return ROLLRIG_OK;
  } catch (const InputError& error) {
    return fail(ROLLRIG_INPUT_ERROR, error.what());
  } catch (const RunFailure& error) {
    return fail(ROLLRIG_RUN_FAILED, error.what());
  } catch (const Interrupted& error) {
    return fail(ROLLRIG_RUN_FAILED, error.what());
  } catch (const std::exception& error) {
    return fail(ROLLRIG_INTERNAL_ERROR, error.what());
  } catch (...) {
    return fail(ROLLRIG_INTERNAL_ERROR, "unknown failure");
  }
}

template <class Object>
Object& require(Object* object) {
  if (object == nullptr) throw c_error("a pointer is null");
  return *object;
}

/// Throws InputError where `count`, the number of values that the caller gives or takes, is not `wanted`, or there are
/// none at `pointer`.
void require_count(const void* pointer, int count, std::size_t wanted) {
  if (wanted > 0 && pointer == nullptr) throw c_error("a pointer is null");
  if (count >= 0 && static_cast<std::size_t>(count) == wanted) return;
  throw c_error("the number of values is wrong", "count", fmt::format("{}", count), fmt::format("{}", wanted));
}

template <class List>
const typename List::value_type* find_at(const List& list, int index) {
  const bool is_in = index >= 0 && static_cast<std::size_t>(index) < list.size();
  return is_in ? &list[static_cast<std::size_t>(index)] : nullptr;
}

/// Number of a variable; one that is too large is refused by the wheel.
std::size_t to_index(int variable) {
  if (variable < 0) throw c_error("there is no such variable", "variable", fmt::format("{}", variable));
  return static_cast<std::size_t>(variable);
}

std::vector<std::size_t> to_indices(const int* variables, int count) {
  if (count < 0) throw c_error("the number of values is wrong", "count", fmt::format("{}", count), "0 or more");
  if (count > 0) require(variables);
  std::vector<std::size_t> indices;
  for (int i = 0; i < count; ++i) indices.push_back(to_index(variables[i]));
  return indices;
}

fmu::SavedState keep(const rollrig_wheel& wheel) {
  fmu::SavedState state;
  state.wheel = wheel.wheel.take_snapshot();
  return state;
}

/// A name of an asset, a path, or the text of a file, which has more than one line.
ConfigTable read_named_or_text(const std::string& folder, const char* given) {
  const std::string text = &require(given);
  if (text.find('\n') != std::string::npos) return parse_config(text, "text of " + folder);
  return read_config(find_asset(folder, text));
}

/// As it stands after "key=".
std::string to_setting(const std::string& key, const Json& value) {
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find('\0') == std::string::npos) return text;
  throw c_error("a text has a NUL character, at which names of files end", key, value.dump(), "text without one");
}

InputError wrong_member(const std::string& what, const std::string& key, const Json& value,
                        const std::string& allowed) {
  return c_error(what, key, shorten(value.dump(), 200), allowed);
}

/// An object in an object stands for names with a dot, as null for a setting that is not given.
void add_settings(const Json& given, const std::string& prefix, std::vector<std::string>& settings) {
  for (const auto& [name, value] : given.items()) {
    const std::string key = prefix + name;
    if (key == "effects" && !value.is_object() && !value.is_null()) {
      throw wrong_member("'effects' must be an object", key, value, R"({"bearing_warmup": {}})");
    }
    if (value.is_object() && (!value.empty() || key == "effects")) {
      add_settings(value, key + ".", settings);
    } else if (!value.is_null()) {
      settings.push_back(key + "=" + to_setting(key, value));
    }
  }
}

/// The JSON of a caller, which is in no file.
Json parse_input(const std::string& text) {
  const std::string example = R"({"scenario": "warm_up", "tire": "a50", "settings": {"speed_km_h": 120}})";
  try {
    Json json = parse_json(text, "input");
    if (json.is_object()) return json;
    throw wrong_member("the input of a run is JSON, but no object", "input", json, example);
  } catch (const InputError& error) {
    const InputProblem& problem = error.problem();
    if (problem.file.empty()) throw;
    const std::string place = problem.line > 0 ? fmt::format(" (line {} of the text)", problem.line) : "";
    throw c_error(fmt::format("the input of a run cannot be read: {}{}", problem.what, place), "input", problem.value,
                  example);
  }
}

RunInput read_run_input(const std::string& text) {
  RunInput input;
  const std::map<std::string, std::string*> members{
      {"scenario", &input.scenario_or_file}, {"tire", &input.tire},         {"rig", &input.rig},
      {"vehicle", &input.vehicle},           {"fidelity", &input.fidelity}, {"baseline", &input.baseline},
      {"sensors", &input.sensors},           {"seed", &input.seed}};
  std::vector<std::string> names{"settings"};
  for (const auto& member : members) names.push_back(member.first);
  const Json json = parse_input(text);
  for (const auto& [key, value] : json.items()) {
    const auto member = members.find(key);
    if (member == members.end() && key != "settings") throw InputError(unknown_name("member of a run", key, names));
    if (value.is_null()) continue;  // as if it were not there
    if (key == "settings") {
      if (!value.is_object()) {
        throw wrong_member("'settings' must be an object", key, value, R"({"speed_km_h": 120})");
      }
      add_settings(value, "", input.settings);
    } else if (value.is_string() || (key == "seed" && value.is_number())) {
      *member->second = to_setting(key, value);
    } else {
      throw wrong_member(fmt::format("'{}' must be a text", key), key, value, "a text in quotes");
    }
  }
  return input;
}

}  // namespace
}  // namespace rollrig

using namespace rollrig;  // NOLINT: C functions follow

int rollrig_c_api_version() { return ROLLRIG_C_API_VERSION; }
const char* rollrig_last_error() { return last_error.c_str(); }

rollrig_wheel* rollrig_wheel_create(const char* tire, const char* rig) {
  rollrig_wheel* made = nullptr;
  run_c([&] {
    const models::TireFile tire_file = models::read_tire(read_named_or_text("tires", tire));
    const rigs::RigFile rig_file = rigs::read_rig(read_named_or_text("rigs", rig));
    made = new rollrig_wheel{fmu::WarmWheel(exports::make_wheel_model(tire_file, rig_file, {}))};
  });
  return made;
}

void rollrig_wheel_free(rollrig_wheel* wheel) { delete wheel; }

int rollrig_wheel_variable_count(const rollrig_wheel* wheel) {
  return wheel == nullptr ? 0 : static_cast<int>(wheel->wheel.variables().size());
}

const char* rollrig_wheel_variable_name(const rollrig_wheel* wheel, int variable) {
  const fmu::Variable* found = wheel == nullptr ? nullptr : find_at(wheel->wheel.variables(), variable);
  return found == nullptr ? nullptr : found->name.c_str();
}

const char* rollrig_wheel_variable_role(const rollrig_wheel* wheel, int variable) {
  constexpr const char* kRoles[] = {"input", "output", "state", "rate", "parameter", "time"};
  const fmu::Variable* found = wheel == nullptr ? nullptr : find_at(wheel->wheel.variables(), variable);
  return found == nullptr ? nullptr : kRoles[static_cast<std::size_t>(found->role)];
}

int rollrig_wheel_find_variable(const rollrig_wheel* wheel, const char* name) {
  if (wheel == nullptr || name == nullptr) return -1;
  const std::vector<fmu::Variable>& all = wheel->wheel.variables();
  const auto is_it = [name](const fmu::Variable& variable) { return variable.name == name; };
  const auto found = std::find_if(all.begin(), all.end(), is_it);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

int rollrig_wheel_set(rollrig_wheel* wheel, int variable, double value) {
  return run_c([&] { require(wheel).wheel.set(to_index(variable), value); });
}

int rollrig_wheel_get(rollrig_wheel* wheel, int variable, double* value) {
  return run_c([&] { require(value) = require(wheel).wheel.get(to_index(variable)); });
}

int rollrig_wheel_set_slope(rollrig_wheel* wheel, int variable, double slope_per_s) {
  return run_c([&] { require(wheel).wheel.set_input_slope(to_index(variable), slope_per_s); });
}

int rollrig_wheel_start(rollrig_wheel* wheel, double time_s) {
  return run_c([&] { require(wheel).wheel.initialize(time_s); });
}

int rollrig_wheel_step(rollrig_wheel* wheel, double step_s) {
  return run_c([&] { require(wheel).wheel.advance(step_s); });
}

int rollrig_wheel_reset(rollrig_wheel* wheel) {
  return run_c([&] { require(wheel).wheel.reset(); });
}

int rollrig_wheel_state_count(const rollrig_wheel* wheel) {
  return wheel == nullptr ? 0 : static_cast<int>(wheel->wheel.state_count());
}

int rollrig_wheel_get_states(rollrig_wheel* wheel, double* states, int count) {
  return run_c([&] {
    require_count(states, count, require(wheel).wheel.state_count());
    wheel->wheel.get_states(states);
  });
}

int rollrig_wheel_set_states(rollrig_wheel* wheel, const double* states, int count) {
  return run_c([&] {
    require_count(states, count, require(wheel).wheel.state_count());
    wheel->wheel.set_states(states);
  });
}

int rollrig_wheel_get_rates(rollrig_wheel* wheel, double* rates, int count) {
  return run_c([&] {
    fmu::WarmWheel& of = require(wheel).wheel;
    require_count(rates, count, of.state_count());
    of.get_rates(rates);
  });
}

int rollrig_wheel_differentiate(rollrig_wheel* wheel, const int* unknown, int unknown_count, const int* known,
                                int known_count, const double* direction, double* derivatives) {
  return run_c([&] {
    if (known_count > 0) require(direction);
    if (unknown_count > 0) require(derivatives);
    const std::vector<std::size_t> by = to_indices(known, known_count);
    const std::vector<double> found =
        require(wheel).wheel.differentiate(to_indices(unknown, unknown_count), by, {direction, direction + by.size()});
    std::copy(found.begin(), found.end(), derivatives);
  });
}

int rollrig_wheel_saved_size(const rollrig_wheel* wheel) {
  if (wheel == nullptr) return 0;
  try {
    return static_cast<int>(count_bytes(keep(*wheel)));
  } catch (...) {  // out of memory
    return 0;
  }
}

int rollrig_wheel_save(const rollrig_wheel* wheel, char* bytes, int size) {
  return run_c([&] {
    const std::vector<char> saved = fmu::serialize(keep(require(wheel)));
    require_count(bytes, size, saved.size());
    std::copy(saved.begin(), saved.end(), bytes);
  });
}

int rollrig_wheel_load(rollrig_wheel* wheel, const char* bytes, int size) {
  return run_c([&] {
    require(bytes);
    require(wheel).wheel.restore(fmu::deserialize(bytes, static_cast<std::size_t>(std::max(size, 0))).wheel);
  });
}

rollrig_run* rollrig_run_carry_out(const char* input) {
  std::unique_ptr<rollrig_run> made;
  const int status = run_c([&] {
    const RunResult result = Run(read_run_input(&require(input))).carry_out();
    Recording recording = result.make_recording();
    made = std::make_unique<rollrig_run>();
    made->json = result.json;
    made->channels.push_back({"time_s", "s", std::move(recording.time_s)});
    for (Channel& channel : recording.channels) made->channels.push_back(std::move(channel));
  });
  return status == ROLLRIG_OK ? made.release() : nullptr;
}

void rollrig_run_free(rollrig_run* run) { delete run; }

const char* rollrig_run_json(const rollrig_run* run) { return run == nullptr ? nullptr : run->json.c_str(); }

int rollrig_run_row_count(const rollrig_run* run) {
  return run == nullptr ? 0 : static_cast<int>(run->channels.front().values.size());
}

int rollrig_run_channel_count(const rollrig_run* run) {
  return run == nullptr ? 0 : static_cast<int>(run->channels.size());
}

const char* rollrig_run_channel_name(const rollrig_run* run, int channel) {
  const Channel* found = run == nullptr ? nullptr : find_at(run->channels, channel);
  return found == nullptr ? nullptr : found->name.c_str();
}

int rollrig_run_get_channel(const rollrig_run* run, int channel, double* values, int count) {
  return run_c([&] {
    const Channel* found = find_at(require(run).channels, channel);
    if (found == nullptr) throw c_error("there is no such channel", "channel", fmt::format("{}", channel));
    require_count(values, count, found->values.size());
    std::copy(found->values.begin(), found->values.end(), values);
  });
}
