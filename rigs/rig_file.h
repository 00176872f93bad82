#pragma once
/// assets/rigs/<name>.toml: reading, with every rule of formats.md.

#include <string>

#include "models/ports.h"
#include "models/tire/tire_file.h"
#include "rigs/machine.h"

namespace rollrig::rigs {

/// A drum, or a roller of a dynamometer.
struct DrumParameters {
  double diameter_m = 0.0;
  double inertia_kg_m2 = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"diameter_m", between(0.1, 1000.0), "Diameter of drum or roller"}, p.diameter_m);
    visit(Field{"inertia_kg_m2", between(0.0001, 1000000000.0), "Moment of inertia about its axis"}, p.inertia_kg_m2);
  }
};

/// A flat belt over two drums.
struct BeltParameters {
  double moving_mass_kg = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"moving_mass_kg", between(0.001, 100000000.0),
                "Belt, and the inertia of its drums and motor as mass at its surface"},
          p.moving_mass_kg);
  }
};

struct RigEnvironment {
  double ambient_K = 0.0;
  double ambient_pressure_Pa = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"ambient_degC", between(-60.0, 80.0), "Air at the tire"}, p.ambient_K);
    visit(Field{"ambient_pressure_kPa", between(50.0, 110.0), "Absolute pressure of the air. Assumed: 101.325 kPa",
                kStandardAtmosphere_Pa / 1e3},
          p.ambient_pressure_Pa);
  }
};

struct SkimParameters {
  double load_N = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"load_N", between(0.01, 1000000.0), "Load of the skim test"}, p.load_N);
  }
};

/// Loads of the skim test for tires of commercial vehicles; 0: that of [skim].
struct SkimByClassParameters {
  double c2_load_N = 0.0;
  double c3_load_N = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"C2_load_N", between(0.0, 1000000.0), "Load of the skim test of a tire of class C2; 0: that of [skim]",
                0.0},
          p.c2_load_N);
    visit(Field{"C3_load_N", between(0.0, 1000000.0), "Likewise of class C3", 0.0}, p.c3_load_N);
  }
};

/// The carriage that presses the wheel on the drum or belt, from above.
struct CarriageParameters {
  double mass_kg = 0.0;
  double damping_N_s_per_m = 0.0;
  double load_time_constant_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"mass_kg", between(0.1, 1000000.0),
                "Moving mass without the wheel. Assumed: 155 kg, a bounce of 5.6 Hz", 155.0},
          p.mass_kg);
    visit(Field{"damping_N_s_per_m", between(0.0, 1e9),
                "Damper of the load cylinder. Assumed: 9 kN s/m, 0.7 of critical", 9000.0},
          p.damping_N_s_per_m);
    visit(Field{"load_time_constant_s", between(0.005, 2.0),
                "Of the cylinder after a change of load (first order). Assumed: 0.015 s, a servo valve: a step "
                "would throw the wheel off the drum",
                0.015},
          p.load_time_constant_s);
  }
};

/// What holds a vehicle on the rollers of a dynamometer, at its tow points (§3.4.2).
struct TieDownParameters {
  double stiffness_N_per_m = 0.0;
  double damping_N_s_per_m = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"stiffness_N_per_m", between(1000.0, 10000000000.0), "Along the vehicle, in all. Assumed: 2 MN/m", 2e6},
          p.stiffness_N_per_m);
    visit(
        Field{"damping_N_s_per_m", between(1.0, 1000000000.0), "Likewise. Assumed: 100 kN s/m, 0.75 of critical", 1e5},
        p.damping_N_s_per_m);
  }
};

/// The speed controller of the drum's motor: proportional and integral, with feedforward of inertia. On a
/// dynamometer, that of the rollers' common speed, and of the driver.
struct DriveParameters {
  double bandwidth_rad_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"bandwidth_rad_s", between(0.001, 10000.0),
                "Natural frequency of the speed loop, critically damped. Assumed: 3 rad/s", 3.0},
          p.bandwidth_rad_s);
  }
};

struct RigFile {
  std::string path;
  std::string content;  // as read, for the manifest's hash
  std::string name;
  const MachineKind* kind = nullptr;
  std::string conductances_of;  // the rig at which a tire's conductances hold here as well; empty: its own
  DrumParameters drum;          // of each roller on a dyno
  BeltParameters belt;
  bool driven_wheels_only = false;  // of a dyno: axles without a drive share stand still, their tires lose nothing
  models::ParasiticParameters<double> parasitic;
  models::ParasiticParameters<double> parasitic_uncertainties;  // 0 where none was given
  RigEnvironment environment;
  SkimParameters skim;  // with a tire: the load of its class, set by use_skim_load_of_class()
  SkimByClassParameters skim_by_class;
  CarriageParameters carriage;
  DriveParameters drive;
  TieDownParameters tie_down;
  models::TireCooling tire_cooling;                // none given: tires must have their conductances
  models::TireCooling tire_cooling_uncertainties;  // 0 where none was given

  /// The rig by whose name a tire file has its conductances.
  const std::string& thermal_name() const { return conductances_of.empty() ? name : conductances_of; }
  /// What a tire takes its conductances from.
  models::CoolingRig cooling_rig() const { return {thermal_name(), tire_cooling, tire_cooling_uncertainties}; }
  bool is_curved() const { return drum.diameter_m > 0.0; }
  double curvature_per_m() const { return is_curved() ? 2.0 / drum.diameter_m : 0.0; }
  /// Torque at the axis of drum or roller over force at its surface; 1 of a belt, whose motor is taken as a force.
  double lever_m() const { return is_curved() ? drum.diameter_m / 2.0 : 1.0; }
  /// Moment of inertia about that axis, or mass.
  double inertia() const { return is_curved() ? drum.inertia_kg_m2 : belt.moving_mass_kg; }

  /// Whether a table must stand in the file, may be left out since its keys have defaults, or need not apply.
  enum class Presence { kRequired, kDefaults, kOptional };

  /// Calls visit(name, table, Presence) for each table that the file of such a machine has.
  template <class Self, class Visit>
  static void visit_tables(Self& rig, const Visit& visit) {
    const models::MachineTraits& machine = rig.kind->traits;
    if (machine.surface == models::Surface::kDrum) visit("drum", rig.drum, Presence::kRequired);
    if (machine.surface == models::Surface::kBelt) visit("belt", rig.belt, Presence::kRequired);
    if (machine.surface == models::Surface::kRoller) visit("roller", rig.drum, Presence::kRequired);
    if (is_indoors(machine)) visit("parasitic", rig.parasitic, Presence::kRequired);
    visit("environment", rig.environment, Presence::kRequired);
    visit("skim", rig.skim, has_skim(machine) ? Presence::kRequired : Presence::kOptional);
    if (has_skim(machine)) visit("skim_by_class", rig.skim_by_class, Presence::kOptional);
    if (has_skim(machine)) visit("carriage", rig.carriage, Presence::kDefaults);
    if (is_tied_down(machine)) visit("tie_down", rig.tie_down, Presence::kDefaults);
    if (is_indoors(machine)) visit("drive", rig.drive, Presence::kDefaults);
    visit("tire_cooling", rig.tire_cooling, Presence::kOptional);
  }
};

/// Reads a rig from parsed TOML. Throws InputError.
RigFile read_rig(const ConfigTable& config);

/// Sets the load of the skim test to that of [skim_by_class] for the tire's class, where there is one, and empties
/// [skim_by_class]: then the rig is one for this tire.
void use_skim_load_of_class(RigFile& rig, const models::TireFile& tire);

/// "all_wheels" or "driven_wheels": what rolls on a dyno.
const char* name_of_rolling_wheels(const RigFile& rig);

/// The file as TOML.
std::string write_rig(const RigFile& rig);

/// What the equations take of a tire on this rig. Throws InputError when the tire lacks a table.
models::Context<double> make_context(const models::TireFile& tire, const RigFile& rig, models::Baseline baseline);

}  // namespace rollrig::rigs
