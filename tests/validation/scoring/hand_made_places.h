#pragma once
/// Places in which the effects of a case act, made by hand.

#include "validation/scoring/locations.h"

namespace rollrig::tests {

constexpr const char* kTorque = "drum_torque_Nm";
constexpr const char* kLiner = "liner_temperature_degC";
constexpr const char* kPressure = "cavity_pressure_kPa";

/// Two phases of two runs in three channels. `mean` is the shift in noise floors of 0.5 N after retuning, `before` that
/// without; each place has sqrt(blocks) rms as listed.
inline std::vector<validation::TruePlace> make_places(double mean = 0.0, double before = 0.0) {
  std::vector<validation::TruePlace> places;
  const auto add = [&](const char* channel, const char* run, double begin, double rest) {
    places.push_back({{channel, run, "begin", 0.0, 600.0, 0.5, "N"}, 16, {before, 9.0}, {mean, begin / 4.0}});
    places.push_back({{channel, run, "rest", 600.0, 690.0, 0.5, "N"}, 9, {before, 9.0}, {mean, rest / 3.0}});
  };
  add(kTorque, "run_1", 8.0, 4.0);
  add(kTorque, "run_2", 5.0, 4.5);
  add(kLiner, "run_1", 9.0, 3.0);
  add(kLiner, "run_2", 2.0, 2.0);
  add(kPressure, "run_1", 1.0, 1.0);
  add(kPressure, "run_2", 0.0, 5.0);
  return places;
}

/// Of such a place, with a size in N.
inline diagnosis::Location name_place(const char* channel, const char* run, const std::string& phase, double size_N) {
  diagnosis::Location named;
  named.channel = channel;
  named.run = run;
  named.phase = phase;
  named.size = size_N;
  named.unit = "N";
  named.start_s = phase == "begin" ? 0.0 : 600.0;
  named.end_s = phase == "begin" ? 600.0 : 690.0;
  return named;
}

}  // namespace rollrig::tests
