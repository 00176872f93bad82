#pragma once
/// A tire as a file describes it: the numbers that the equations of models/ take.

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/core/scalar.h"
#include "sim/core/schema.h"

namespace rollrig::models {

/// Geometry and mass. Source: §3.1.1 and Table 3.1 for the diameters.
template <class S>
struct TireGeometry {
  S outer_diameter_m{};
  S section_width_m{};
  S rim_diameter_m{};
  S mass_kg{};
  S wheel_mass_kg{};
  S spin_inertia_kg_m2{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"outer_diameter_m", between(0.1, 10.0), "Nominal design diameter, unloaded"}, p.outer_diameter_m);
    visit(Field{"section_width_m", between(0.01, 3.0), "Section width"}, p.section_width_m);
    visit(Field{"rim_diameter_m", between(0.05, 8.0), "Rim diameter"}, p.rim_diameter_m);
    visit(Field{"mass_kg", between(0.01, 10000.0), "Mass of the tire"}, p.mass_kg);
    visit(Field{"wheel_mass_kg", between(0.01, 10000.0), "Mass of the rim and the hub that turn with the tire"},
          p.wheel_mass_kg);
    visit(Field{"spin_inertia_kg_m2", between(1e-5, 100000.0), "Moment of inertia about the spin axis, tire and wheel"},
          p.spin_inertia_kg_m2);
  }
};

/// Stiffness of the tire against the surface.
template <class S>
struct TireStiffness {
  S vertical_N_per_m{};
  S vertical_damping_N_s_per_m{};
  S slip_stiffness_N{};
  S relaxation_length_m{};
  S friction_coefficient{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"vertical_N_per_m", between(1000.0, 100000000.0), "Vertical stiffness dFz/dz"}, p.vertical_N_per_m);
    visit(Field{"vertical_damping_N_s_per_m", between(0.0, 1e6), "Vertical damping"}, p.vertical_damping_N_s_per_m);
    visit(Field{"slip_stiffness_N", between(10.0, 1000000000.0),
                "dFx/dslip at the reference load; acts with slip_loss only"},
          p.slip_stiffness_N);
    visit(Field{"relaxation_length_m", between(0.0001, 100.0),
                "Longitudinal relaxation length; acts with slip_loss only"},
          p.relaxation_length_m);
    visit(Field{"friction_coefficient", between(0.01, 10.0),
                "Fx/Fz at which the contact slides. Assumed: 1 on dry steel", 1.0},
          p.friction_coefficient);
  }
};

/// Coefficients of loss and of its fall with temperature, each a line over speed (source (3.4), (3.6)).
template <class S>
struct SpeedLines {
  S A0_N{};
  S A1_N_s_per_m{};
  S B0_per_K{};
  S B1_s_per_m_K{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"A0_N", any_number(), "Loss at standstill and 0 degC; A is not negative from lowest_speed_km_h up"},
          p.A0_N);
    visit(Field{"A1_N_s_per_m", any_number(), "Its rise with speed"}, p.A1_N_s_per_m);
    visit(Field{"B0_per_degC", any_number(), "Its relative fall with tire temperature at standstill"}, p.B0_per_K);
    visit(Field{"B1_s_per_m_degC", any_number(), "The rise of that fall with speed"}, p.B1_s_per_m_K);
  }
};

/// What a law of the loss refers to, and how the loss goes with pressure.
template <class S>
struct LossReference {
  S reference_load_N{};
  S reference_pressure_Pa{};  // gauge
  S reference_drum_diameter_m{};
  S pressure_exponent{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"reference_load_N", between(10.0, 1000000.0), "Load at which the loss of the law holds"},
          p.reference_load_N);
    visit(Field{"reference_pressure_kPa", between(1.0, 10000.0), "Gauge pressure at which it holds"},
          p.reference_pressure_Pa);
    visit(Field{"reference_drum_diameter_m", between(0.1, 1e12), "Drum on which it holds"},
          p.reference_drum_diameter_m);
    visit(Field{"pressure_exponent", between(0.0, 2.0), "a of (p/p_ref)^-a"}, p.pressure_exponent);
  }
};

/// Parameters of the source's law; see models/tire/rolling_resistance.h.
template <class S>
struct RollingResistanceParameters : LossReference<S>, SpeedLines<S> {
  S lowest_speed_m_s{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    LossReference<S>::visit(p, visit);
    visit(Field{"lowest_speed_km_h", between(0.0, 100.0), "Below it A and B are held at their values there", 0.0},
          p.lowest_speed_m_s);
    SpeedLines<S>::visit(p, visit);
  }
};

/// Coefficients fitted at one load; a map of them over load is the second load compensation of §3.3.1.3.
template <class S>
struct LoadMapEntry : SpeedLines<S> {
  S load_N{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"load_N", between(1.0, 1000000.0), "Load at which the entry was fitted"}, p.load_N);
    SpeedLines<S>::visit(p, visit);
  }
};

/// One rubber node and one gas node (source §3.3.2.1, (3.17)).
template <class S>
struct TireThermalParameters {
  S heat_capacity_J_per_K{};
  S gas_heat_capacity_J_per_K{};
  S H_gas_W_per_K{};
  S rest_conductance_W_per_K{};  // the source's z
  S road_share_of_rest_conductance{};
  S speed_conductance_W_s_per_m_K{};  // the source's f
  S road_share_of_speed_conductance{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"heat_capacity_J_per_K", between(1.0, 100000000.0), "Heat capacity of the rubber"},
          p.heat_capacity_J_per_K);
    visit(Field{"gas_heat_capacity_J_per_K", between(0.001, 1000000.0), "Heat capacity of the inflation gas"},
          p.gas_heat_capacity_J_per_K);
    visit(Field{"H_gas_W_per_K", between(1e-6, 1000000.0), "Conductance from rubber to gas"}, p.H_gas_W_per_K);
    visit(Field{"conductance_at_rest_W_per_K", non_negative(),
                "Speed-independent conductance to air and road. 0 with that per speed: by the rig's [tire_cooling]",
                0.0, "z_W_per_K"},
          p.rest_conductance_W_per_K);
    visit(Field{"road_share_of_conductance_at_rest", between(0.0, 1.0),
                "Share of the conductance at rest that goes to the road. Assumed: 0.5", 0.5, "road_share_of_z"},
          p.road_share_of_rest_conductance);
    visit(Field{"conductance_per_speed_W_s_per_m_K", non_negative(), "Conductance to air and road per unit of speed",
                0.0, "f_W_s_per_m_K"},
          p.speed_conductance_W_s_per_m_K);
    visit(Field{"road_share_of_conductance_per_speed", between(0.0, 1.0),
                "Share of the conductance per speed that goes to the road. Default: all of it to the air", 0.0},
          p.road_share_of_speed_conductance);
  }
};

/// The constant-coefficient law that most vehicle simulators have.
template <class S>
struct ConstantLossParameters {
  S rrc{};  // N/N

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"rrc_N_per_kN", non_negative(), "Constant rolling-resistance coefficient"}, p.rrc);
  }
};

struct TireModel;  // models/tire/tire_model.h

/// When a fit of a tire asks for a number. One for which it does not ask stays that of the file, or moves within the
/// standard uncertainty that the file gives.
enum class FitRole {
  kHeld,
  kFree,
  kFreeOverSpeeds,           // with several speeds
  kFreeOverSpeedsWithinLaw,  // the same; held at `usual` where the data put it where find_mistake refuses the numbers
  kFreeOverLoads             // with several loads
};

/// A number that only one tire model has.
struct TireModelParameter {
  Field field;
  double usual = 0.0;  // of a passenger car's tire, in the unit of the key; tests take it
  /// Its standard uncertainty where a file gives none, as a share: of the file's value in a diagnosis
  /// (diagnosis/comparison/base_parameters.h), of `usual` in a fit (estimation/tire_fit/class_priors.h).
  double usual_sd = 0.0;
  FitRole role = FitRole::kHeld;
};

constexpr const char* kConstantModel = "constant_rrc";
const TireModel& default_tire_model();
const std::string& id_of(const TireModel& model);
const std::vector<TireModelParameter>& own_parameters_of(const TireModel& model);

/// The model of a tire, and the numbers that only this model has, in the order of its declaration.
template <class S>
struct OwnParameters {
  const TireModel* model = &default_tire_model();
  std::vector<S> values;

  const S& operator[](std::size_t i) const { return values[i]; }

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    const std::vector<TireModelParameter>& declared = own_parameters_of(*p.model);
    for (std::size_t i = 0; i < p.values.size(); ++i) visit(declared[i].field, p.values[i]);
  }
};

/// Every number of a tire that enters an equation.
template <class S>
struct TireParameters {
  TireGeometry<S> geometry;
  TireStiffness<S> stiffness;
  RollingResistanceParameters<S> rolling_resistance;
  std::vector<LoadMapEntry<S>> load_map;  // by increasing load; empty = one set of coefficients
  TireThermalParameters<S> thermal;
  ConstantLossParameters<S> constant;
  OwnParameters<S> own;

  const TireModel& model() const { return *own.model; }

  /// Calls visit(table, field, member) for every number; the tables of the load map are "load_map.0" and so on.
  template <class Self, class Visit>
  static void visit_all(Self& p, Visit&& visit) {
    const auto table = [&visit](const std::string& name) {
      return [&visit, name](const Field& field, auto& member) { visit(name, field, member); };
    };
    TireGeometry<S>::visit(p.geometry, table("geometry"));
    TireStiffness<S>::visit(p.stiffness, table("stiffness"));
    RollingResistanceParameters<S>::visit(p.rolling_resistance, table("rolling_resistance"));
    for (std::size_t i = 0; i < p.load_map.size(); ++i) {
      LoadMapEntry<S>::visit(p.load_map[i], table("load_map." + std::to_string(i)));
    }
    TireThermalParameters<S>::visit(p.thermal, table("thermal"));
    ConstantLossParameters<S>::visit(p.constant, table("constant"));
    OwnParameters<S>::visit(p.own, table(id_of(p.model())));
  }
};

/// A number in SI units. Its dimension, where the scalar has one, is that of the key's unit.
template <class S>
S quantity_of_key(double si_value, std::string_view key) {
  if constexpr (std::is_same_v<S, DimensionedScalar>) {
    return quantity<S>(si_value, unit_of_key(key).dimension);
  } else {
    return S(si_value);
  }
}

/// A visited group in another scalar, field by field.
template <class S, template <class> class Group>
Group<S> convert(const Group<double>& from) {
  std::vector<double> values;
  Group<double>::visit(from, [&values](const Field&, const double& member) { values.push_back(member); });
  Group<S> to;
  std::size_t i = 0;
  Group<S>::visit(to, [&](const Field& field, S& member) { member = quantity_of_key<S>(values[i++], field.key); });
  return to;
}

template <class S>
TireParameters<S> convert_tire(const TireParameters<double>& from) {
  TireParameters<S> to;
  to.geometry = convert<S>(from.geometry);
  to.stiffness = convert<S>(from.stiffness);
  to.rolling_resistance = convert<S>(from.rolling_resistance);
  for (const LoadMapEntry<double>& entry : from.load_map) to.load_map.push_back(convert<S>(entry));
  to.thermal = convert<S>(from.thermal);
  to.constant = convert<S>(from.constant);
  to.own.model = from.own.model;
  OwnParameters<double>::visit(from.own, [&to](const Field& field, const double& value) {
    to.own.values.push_back(quantity_of_key<S>(value, field.key));
  });
  return to;
}

/// What the tire gives to air and road per kelvin, all in all.
/// Equation  z + f v
/// Symbols   z conductance at rest [W/K], f per speed [W s/(m K)], v speed of the air at the tire [m/s]
/// Source    (3.12), (3.17)
template <class S>
S calc_cooling_W_per_K(const TireThermalParameters<S>& thermal, const S& air_speed_m_s) {
  return thermal.rest_conductance_W_per_K + thermal.speed_conductance_W_s_per_m_K * air_speed_m_s;
}

/// Loaded radius r_l = D/2 - Fz/k_z [m]. Assumed: a linear spring, and that it is the rolling radius as well.
template <class S>
S calc_loaded_radius_m(const TireParameters<S>& tire, const S& load_N) {
  return tire.geometry.outer_diameter_m / 2.0 - load_N / tire.stiffness.vertical_N_per_m;
}

/// Equivalent mass of a wheel's spin at a rolling radius, I_spin/r^2 [kg].
template <class S>
S calc_spin_mass_kg(const TireParameters<S>& tire, const S& radius_m) {
  return tire.geometry.spin_inertia_kg_m2 / (radius_m * radius_m);
}

}  // namespace rollrig::models
