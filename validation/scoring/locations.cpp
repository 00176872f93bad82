#include "validation/scoring/locations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/error.h"

namespace rollrig::validation {
namespace {

Json make_change(const TrueChange& change) { return {{"mean", change.mean}, {"rms", change.rms}}; }

TrueChange read_change(const Json& json) { return {json.at("mean").get<double>(), json.at("rms").get<double>()}; }

constexpr double kAmongLargest = 0.8;  // of the largest, in noise floors
constexpr double kOfStated = 0.5;      // of the size that an answer states

/// The place that a location names. Throws InputError where there is none.
const TruePlace& find_place(const diagnosis::Location& named, const std::vector<TruePlace>& places) {
  constexpr double kSame_s = 0.5;
  for (const TruePlace& place : places) {
    const diagnosis::LocationStretch& at = place.stretch;
    const bool is_same_time =
        std::abs(at.start_s - named.start_s) < kSame_s && std::abs(at.end_s - named.end_s) < kSame_s;
    if (at.channel == named.channel && at.run == named.run && is_same_time) return place;
  }
  throw InputError({"an answer names a place that the file of locations lacks", kLocationsFile, 0, "",
                    fmt::format("{}, {}, {}", named.channel, named.run, named.phase),
                    "rollrig_validation locations, by the program that answered", ""});
}

double sum_squares(const TruePlace& place) {
  return static_cast<double>(place.blocks) * place.after_retuning.rms * place.after_retuning.rms;
}

/// Whether `name` is among those that hold most.
bool is_among_largest(const std::string& name, const std::map<std::string, double>& squares) {
  double largest = 0.0;
  for (const auto& [other, sum] : squares) largest = std::max(largest, sum);
  const double own = squares.at(name);
  return own > 0.0 && own >= kAmongLargest * kAmongLargest * largest;
}

}  // namespace

LocationCheck check_largest(const diagnosis::Location& named, const std::vector<TruePlace>& places) {
  const diagnosis::LocationStretch& stretch = find_place(named, places).stretch;
  std::map<std::string, double> channels, runs, phases;
  for (const TruePlace& place : places) {
    const diagnosis::LocationStretch& at = place.stretch;
    channels[at.channel] += sum_squares(place);
    if (at.channel != stretch.channel) continue;
    runs[at.run] += sum_squares(place);
    if (at.run == stretch.run) phases[at.phase] += sum_squares(place);
  }
  return {is_among_largest(stretch.channel, channels), is_among_largest(stretch.run, runs),
          is_among_largest(stretch.phase, phases)};
}

bool is_shifted(const diagnosis::Location& named, const std::vector<TruePlace>& places) {
  const TruePlace& place = find_place(named, places);
  const double stated = named.size / place.stretch.floor;
  const auto holds = [&](const TrueChange& change) {
    return change.mean * stated > 0.0 && std::abs(change.mean) >= kOfStated * std::abs(stated);
  };
  return holds(place.after_retuning) || holds(place.of_effects);
}

Json make_places_json(const std::vector<TruePlace>& places) {
  Json json = Json::array();
  for (const TruePlace& place : places) {
    const diagnosis::LocationStretch& at = place.stretch;
    json.push_back({{"channel", at.channel},
                    {"run", at.run},
                    {"phase", at.phase},
                    {"start_s", at.start_s},
                    {"end_s", at.end_s},
                    {"floor", at.floor},
                    {"unit", at.unit},
                    {"blocks", place.blocks},
                    {"change", make_change(place.of_effects)},
                    {"after_retuning", make_change(place.after_retuning)}});
  }
  return json;
}

std::vector<TruePlace> read_places(const Json& json) {
  std::vector<TruePlace> places;
  for (const Json& of : json) {
    TruePlace place;
    place.stretch.channel = of.at("channel").get<std::string>();
    place.stretch.run = of.at("run").get<std::string>();
    place.stretch.phase = of.at("phase").get<std::string>();
    place.stretch.start_s = of.at("start_s").get<double>();
    place.stretch.end_s = of.at("end_s").get<double>();
    place.stretch.floor = of.at("floor").get<double>();
    place.stretch.unit = of.at("unit").get<std::string>();
    place.blocks = of.at("blocks").get<std::size_t>();
    place.of_effects = read_change(of.at("change"));
    place.after_retuning = read_change(of.at("after_retuning"));
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace rollrig::validation
