#pragma once
/// The tire and the rig or the vehicle of a set: what their files say, with what uncertainty, and what is true.

#include <array>
#include <cstdint>
#include <string>

#include "validation/generator/draws.h"

namespace rollrig::generator {

constexpr double kGasConstant_J_per_mol_K = 8.314462618;  // CODATA 2018
constexpr double kSpeed80_m_s = 80.0 / 3.6;               // to which sizes and shapes of effects refer

/// Numbers that somebody has identified, so that the file has them with an uncertainty: of tire, rig, vehicle.
enum class Base : std::size_t {
  kA0,
  kA1,
  kB0,
  kB1,
  kC,
  kCGas,
  kH,
  kZ,
  kF,
  kC0,
  kC1,
  kC2,
  kMass,
  kRotatingMass,
  kDragArea,
  kRrc,
  kCount
};
constexpr std::size_t kBaseCount = static_cast<std::size_t>(Base::kCount);

struct Identified {
  const char* key = "";  // as in the files of rollrig, unit included
  double nominal = 0.0;
  double sd = 0.0;
  double truth = 0.0;
};

struct Machine;

/// Everything of the laboratory that stays the same over a set. Values in the units of their names.
struct Specimen {
  const Machine* machine = nullptr;
  bool constant_rrc = false;  // the law before any effect is a constant coefficient; on the road
  std::array<Identified, kBaseCount> base;

  double outer_diameter_m = 0.0;
  double section_width_m = 0.0;
  double rim_diameter_m = 0.0;
  double tire_mass_kg = 0.0;
  double wheel_mass_kg = 0.0;
  double spin_inertia_kg_m2 = 0.0;
  double vertical_N_per_m = 0.0;
  double reference_load_N = 5400.0;
  double reference_pressure_kPa = 280.0;
  double pressure_exponent = 0.4;
  double drum_diameter_m = 2.0;     // of the drum or roller, or of each drum under a belt
  double drum_inertia_kg_m2 = 0.0;  // about its axis, of a belt of all that moves
  double ambient_degC = 25.0;
  double skim_load_N = 200.0;

  // Not in the files: how the load cylinder and the speed controller settle after a change of load.
  double load_frequency_rad_s = 6.0;
  double load_damping = 0.5;
  double controller_swing_Nm = 5.0;  // at a change by the reference load
  double controller_time_s = 1.5;
  double controller_frequency_rad_s = 2.0;

  // The vehicle on a dyno or on the road.
  double tires = 4.0;
  double drive_share = 0.0;  // of the motor's force at the wheel on the roller
  double brake_share = 0.0;  // of the braking force at that wheel
  double regeneration_m_s2 = 1.5;
  double regeneration_fade_m_s = 10.0 / 3.6;

  double truth(Base which) const { return base[static_cast<std::size_t>(which)].truth; }
};

/// `nominal_base`: the truth is what the files say.
Specimen draw_specimen(std::uint64_t seed, const Machine& machine, bool constant_rrc, bool nominal_base);

/// Puts the tire of another specimen on a machine: all that its file says of it, and what is true of it.
void put_on_tire(const Specimen& of_tire, Specimen& machine);

std::string write_tire(const Specimen& specimen);
/// Keys of numbers with their uncertainties.
std::string write_identified(const Specimen& specimen, Base first, Base last);
/// As a road set's `baseline` has it.
const char* name_of_law(const Specimen& specimen);
/// To so many significant digits.
double round_to(double value, int digits);

}  // namespace rollrig::generator
