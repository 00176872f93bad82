#pragma once
/// What of a vehicle enters its road load.

#include "sim/core/schema.h"

namespace rollrig::models {

/// What every use of a vehicle needs (formats.md).
template <class S>
struct VehicleBody {
  S mass_kg{};
  S rotating_mass_kg{};
  S drag_area_m2{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"mass_kg", positive(), "Mass as tested"}, p.mass_kg);
    visit(Field{"rotating_mass_kg", non_negative(), "Equivalent mass of all that turns, wheels included"},
          p.rotating_mass_kg);
    visit(Field{"drag_area_m2", non_negative(), "Drag coefficient times frontal area; not needed beside [road_load]"},
          p.drag_area_m2);
  }
};

}  // namespace rollrig::models
