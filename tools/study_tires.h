#pragma once
/// Tires of the studies on other sources, rolled on the 2 m drum.

#include <array>
#include <string>
#include <vector>

#include "scenarios/run/run_spec.h"

namespace rollrig::tools {

inline constexpr const char* kCarTire = "c1_205_55r16";
inline constexpr const char* kTruckTire = "c3_315_80r22_5";
inline const std::array<std::string, 5> kStudyTires{"a40", "a50", "a60", kCarTire, kTruckTire};
inline const std::array<std::string, 4> kStudyCarTires{"a40", "a50", "a60", kCarTire};

/// A tire of the assets, and the drum of 2 m.
struct StudyTire {
  models::TireFile tire;
  rigs::RigFile rig;

  bool is_truck() const { return tire.iso_28580->load_N > 15000.0; }
  double load_N() const { return tire.iso_28580->load_N; }  // of its ISO test
  double pressure_Pa() const { return tire.iso_28580->pressure_Pa; }
  /// Multiplies its conductance to the air and the surface.
  void scale_cooling(double factor);
  /// Puts it on a drum of another diameter that cools it alike.
  void change_drum(double diameter_m) { rig.drum.diameter_m = diameter_m; }
};
StudyTire read_study_tire(const std::string& name);

/// Conditions of a test; pressure gauge, set cold.
struct TestConditions {
  double speed_m_s = 80.0 / 3.6;
  double load_N = 0.0;
  double pressure_Pa = 0.0;
  double ambient_K = kZeroCelsius_K + 25.0;
};
TestConditions make_iso_conditions(const StudyTire& tire);

/// The loss in steady state.
struct SteadyLoss {
  double true_N = 0.0;
  double reported_N = 0.0;  // what is left after the skim test
};
SteadyLoss measure_steady(const StudyTire& tire, const TestConditions& conditions);

/// A stretch of constant conditions.
struct Step {
  double duration_s = 0.0;
  double speed_m_s = 0.0;
  double ambient_K = kZeroCelsius_K + 25.0;
};

/// State of a rolling tire; true loss.
struct RollingState {
  double loss_N = 0.0;
  double tread_K = 0.0;
  double carcass_K = 0.0;
  double pressure_Pa = 0.0;
};

/// Rolls a tire, soaked and inflated at the air of the first step, from step to step under one load. Gives the state
/// every `sample_s`, or at the end of each step where that is 0.
std::vector<RollingState> roll_steps(const StudyTire& tire, double load_N, double cold_pressure_Pa,
                                     const std::vector<Step>& steps, double sample_s = 0.0);

}  // namespace rollrig::tools
