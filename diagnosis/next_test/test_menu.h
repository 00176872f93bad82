#pragma once
/// Tests that could be run next, as programs that can be simulated before.

#include <string>
#include <vector>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::diagnosis {

constexpr double kSoak_h = 3.0;  // Assumed: until nothing of the tire or the bearings remembers

/// A number of the files that a test determines by itself, such as a mass on a scale.
struct NumberReading {
  std::string key;  // as of a base parameter: "vehicle.mass_kg"
  double sd_SI = 0.0;
};

/// A test as an engineer would order it.
struct PlannedTest {
  std::string id;
  std::string description;
  double hours = 0.0;                           // of the rig: set-up, soak and rolling
  std::vector<measurements::MeasuredRun> runs;  // a row every 10 s; in measured columns 0 where read, else NaN
  ExtraReadings extra;
  bool clock_pulse = false;  // an electrical pulse on both loggers, which reads the difference of their clocks
  bool soaked = false;       // every run starts after a soak, else its first half hour warms the tire
  std::vector<std::string> by_hand = {};  // what is done at the rig beside the runs, a sentence each
  std::vector<NumberReading> numbers = {};
};

/// As long as the blocks of a comparison (docs/how_the_diagnosis_reasons.md, "From samples to residuals").
constexpr double kVirtualRow_s = 10.0;

/// What the set's own rig, sensors, tire, usual load and pressure allow. Speeds, loads and durations: Assumed, after
/// the tests of Kolekar and Narasimhan (2024, §3.2); they are what makes each test's own comparison, not a standard's.
/// Set-up takes half an hour (Assumed: wheel mounted, inflated, sensors zeroed), a soak of tire and bearings to the
/// ambient 3 h before each run that starts cold (ISO 28580, thermal conditioning of passenger-car tires), and speed
/// changes go at 1 km/h a second (Assumed). Where a run need not start cold, its first half hour warms the tire and is
/// not read.
/// Reversed rotation: what moves the sensor's zero keeps its sign, all else turns over with the rotation; a session of
/// its own, since the drum was stopped. Weights on a lever: torque or force that is known (Assumed: to much better than
/// the sensor). Scale and counter of turns: columns of a dynamometer's set. A weighed vehicle: its mass and the
/// uncertainty of that in the vehicle's file. Coastdown: forces that are nobody's, so that the loss is that of the
/// rollers or of the wheel alone, and the traction force of a vehicle is none.
/// Not in the menu, since nothing that is recorded would say that they were done: a fan, a coasting drum with known
/// mass added, the wheel of another axle (the equations of one wheel know no axle), the zero of the traction force of a
/// vehicle that stands (what holds it on a slope is not recorded).
/// Checked   tests/diagnosis/next_test_test.cpp
std::vector<PlannedTest> make_test_menu(const PreparedSet& set);

/// Throws InputError unless a machine can be had for so many hours: 0.5 to 1000.
void require_machine_hours(double hours);

/// Whether a set holds all that a test reads.
bool is_held_by_sets(const PlannedTest& test, const rigs::MachineKind& kind);

}  // namespace rollrig::diagnosis
