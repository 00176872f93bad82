#pragma once
/// A machine as physics sees it: a surface, what rolls on it, and what holds that in place.
///
/// Code that asks what holds on a machine asks one of these functions, never which kind of machine it is. So a new
/// kind (docs/add_a_rig.md) has all of its answers by its traits.

#include "models/quantities.h"

namespace rollrig::models {

/// What a tire rolls on.
enum class Surface { kDrum, kBelt, kRoller, kRoad };

/// What its measurements are of: a tire on a spindle of the rig, one wheel of a vehicle, or a whole vehicle.
enum class Specimen { kTire, kWheel, kVehicle };

enum class Restraint { kCarriage, kTieDowns, kNone };

struct MachineTraits {
  Surface surface;
  Specimen specimen;
  Restraint restraint;
  Quantity force;  // the one channel that measures a force, or the torque at a drum's axis
};

constexpr bool is_any(const MachineTraits&) { return true; }
constexpr bool is_none(const MachineTraits&) { return false; }

/// There are slope and weather, and no bearings but the vehicle's own; tires have no sensors, and the force is that of
/// accelerating as well.
constexpr bool is_on_road(const MachineTraits& machine) { return machine.surface == Surface::kRoad; }

/// The surface is moved by a motor in closed air. It has bearings of its own, warms up, and load, force, temperature
/// and pressure are measured at it.
constexpr bool is_indoors(const MachineTraits& machine) { return !is_on_road(machine); }

/// There are friction brakes and a driveline beside the tire.
constexpr bool is_of_vehicle(const MachineTraits& machine) { return machine.specimen != Specimen::kTire; }

/// Restraints pull the vehicle down on its rollers.
constexpr bool is_tied_down(const MachineTraits& machine) { return machine.restraint == Restraint::kTieDowns; }

/// The carriage can take nearly all load off the tire, so that what is left is the machine's own loss.
constexpr bool has_skim(const MachineTraits& machine) { return machine.restraint == Restraint::kCarriage; }

/// The force is read as a torque about the axis of the surface.
constexpr bool reads_torque(const MachineTraits& machine) { return machine.force.unit_suffix() == "Nm"; }

/// The usual drum is the reference for curvature.
constexpr bool is_drum(const MachineTraits& machine) { return machine.surface == Surface::kDrum; }

/// Slip takes next to nothing of a towed wheel, and what is measured at a whole vehicle's motor does not tell it.
constexpr bool hides_slip(const MachineTraits& machine) { return machine.specimen != Specimen::kWheel; }

}  // namespace rollrig::models
