#include "validation/generator/specimen.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

/// Nominal values. Assumed: passenger-car tires of 40 to 65 N at 0 degC and 80 km/h, which is 5 to 8 N/kN
/// warm, and a drum rig with 8 to 14 N of its own at 80 km/h.
void draw_nominal(Draws& draws, Specimen& specimen) {
  const double loss_N = draws.uniform(42.0, 62.0);    // A at 80 km/h
  const double rise = draws.uniform(0.12, 0.45);      // share of it that goes with speed
  const double fall = draws.uniform(0.0105, 0.0165);  // B at 80 km/h
  const double fall_rise = draws.uniform(0.05, 0.35);
  const double cooling_W_per_K = draws.uniform(38.0, 54.0);  // z + f v at 80 km/h
  const double still = draws.uniform(0.22, 0.42);
  const auto set = [&specimen](Base which, const char* key, double nominal) {
    specimen.base[static_cast<std::size_t>(which)] = {key, round_to(nominal, 5), 0.0, 0.0};
  };
  set(Base::kA0, "A0_N", loss_N * (1.0 - rise));
  set(Base::kA1, "A1_N_s_per_m", loss_N * rise / kSpeed80_m_s);
  set(Base::kB0, "B0_per_degC", fall * (1.0 - fall_rise));
  set(Base::kB1, "B1_s_per_m_degC", fall * fall_rise / kSpeed80_m_s);
  set(Base::kC, "heat_capacity_J_per_K", draws.uniform(16000.0, 26000.0));
  set(Base::kCGas, "gas_heat_capacity_J_per_K", draws.uniform(75.0, 118.0));
  set(Base::kH, "H_gas_W_per_K", draws.uniform(2.8, 5.5));
  set(Base::kZ, "z_W_per_K", cooling_W_per_K * still);
  set(Base::kF, "f_W_s_per_m_K", cooling_W_per_K * (1.0 - still) / kSpeed80_m_s);
  set(Base::kC0, "c0_N", draws.uniform(4.5, 7.5));
  set(Base::kC1, "c1_N_s_per_m", draws.uniform(0.11, 0.19));
  set(Base::kC2, "c2_N_s2_per_m2", draws.uniform(0.003, 0.005));
}

/// Relative standard uncertainties about which a laboratory would know its numbers.
constexpr std::array<double, kBaseCount> kRelative{0.02, 0.02, 0.04, 0.04, 0.05, 0.10, 0.15, 0.08,
                                                   0.08, 0.07, 0.07, 0.07, 0.01, 0.10, 0.03, 0.06};

/// Uncertainties and true values.
void draw_truth(Draws& draws, bool nominal_base, Base first, Base last, Specimen& specimen) {
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
    Identified& number = specimen.base[i];
    number.sd = round_to(std::abs(number.nominal) * kRelative[i] * draws.uniform(0.75, 1.25), 3);
    const double step = draws.normal();
    number.truth = nominal_base ? number.nominal : number.nominal + number.sd * step;
  }
}

/// Assumed: passenger cars, by their segments' catalogs. Streams of its own, so that a drum set does not see it.
void draw_vehicle(Draws& draws, bool nominal_base, Specimen& specimen) {
  const auto set = [&specimen](Base which, const char* key, double nominal) {
    specimen.base[static_cast<std::size_t>(which)] = {key, round_to(nominal, 4), 0.0, 0.0};
  };
  const double mass_kg = draws.uniform(1750.0, 2350.0);
  set(Base::kMass, "mass_kg", mass_kg);
  set(Base::kRotatingMass, "rotating_mass_kg", mass_kg * draws.uniform(0.025, 0.045));
  set(Base::kDragArea, "drag_area_m2", draws.uniform(0.55, 0.8));
  set(Base::kRrc, "rrc_N_per_kN", draws.uniform(6.5, 10.5));
  draw_truth(draws, nominal_base, Base::kMass, Base::kRrc, specimen);
  const bool is_driven = draws.happens(0.65);
  const bool is_front = draws.happens(0.5);
  specimen.drive_share = is_driven ? (draws.happens(0.3) ? 0.25 : 0.5) : 0.0;
  specimen.brake_share = is_front ? draws.uniform(0.3, 0.36) : draws.uniform(0.14, 0.2);
  specimen.regeneration_m_s2 = round_to(draws.uniform(1.2, 2.0), 2);
}

void draw_machine(Draws& draws, Specimen& specimen) {
  specimen.outer_diameter_m = round_to(draws.uniform(0.63, 0.74), 4);
  specimen.section_width_m = round_to(draws.uniform(0.205, 0.245), 3);
  specimen.rim_diameter_m = round_to(specimen.outer_diameter_m - draws.uniform(0.19, 0.25), 4);
  specimen.tire_mass_kg = round_to(draws.uniform(8.5, 12.0), 3);
  specimen.wheel_mass_kg = round_to(draws.uniform(10.0, 15.0), 3);
  specimen.spin_inertia_kg_m2 = round_to(draws.uniform(1.1, 1.7), 3);
  specimen.vertical_N_per_m = round_to(draws.uniform(195e3, 250e3), 3);
  specimen.drum_diameter_m = draws.happens(0.7) ? 2.0 : 1.707;  // 1.707 m: the 67 inch drum
  const double radius_m = 0.5 * specimen.drum_diameter_m;
  specimen.drum_inertia_kg_m2 = round_to(draws.uniform(380.0, 520.0) * radius_m * radius_m, 4);
  specimen.ambient_degC = std::round(draws.uniform(22.0, 26.0));
  specimen.load_frequency_rad_s = draws.uniform(5.0, 8.0);
  specimen.load_damping = draws.uniform(0.35, 0.6);
  specimen.controller_swing_Nm = draws.uniform(2.0, 8.0);
  specimen.controller_time_s = draws.uniform(0.8, 2.5);
  specimen.controller_frequency_rad_s = draws.uniform(1.0, 3.0);
}

}  // namespace

double round_to(double value, int digits) {
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1.0 - digits);
  return std::round(value / step) * step;
}

Specimen draw_specimen(std::uint64_t seed, const Machine& machine, bool constant_rrc, bool nominal_base) {
  Specimen specimen;
  specimen.machine = &machine;
  specimen.constant_rrc = constant_rrc;
  Draws nominal(seed, "specimen/nominal");
  Draws body(seed, "specimen/machine");
  Draws truth(seed, "specimen/truth");
  Draws vehicle(seed, "specimen/vehicle");
  draw_nominal(nominal, specimen);
  draw_machine(body, specimen);
  draw_truth(truth, nominal_base, Base::kA0, Base::kC2, specimen);
  draw_vehicle(vehicle, nominal_base, specimen);
  machine.draw_own(seed, specimen);
  return specimen;
}

void put_on_tire(const Specimen& of_tire, Specimen& machine) {
  for (auto i = static_cast<std::size_t>(Base::kA0); i <= static_cast<std::size_t>(Base::kF); ++i) {
    machine.base[i] = of_tire.base[i];
  }
  machine.outer_diameter_m = of_tire.outer_diameter_m;
  machine.section_width_m = of_tire.section_width_m;
  machine.rim_diameter_m = of_tire.rim_diameter_m;
  machine.tire_mass_kg = of_tire.tire_mass_kg;
  machine.wheel_mass_kg = of_tire.wheel_mass_kg;
  machine.spin_inertia_kg_m2 = of_tire.spin_inertia_kg_m2;
  machine.vertical_N_per_m = of_tire.vertical_N_per_m;
  machine.reference_load_N = of_tire.reference_load_N;
  machine.reference_pressure_kPa = of_tire.reference_pressure_kPa;
  machine.pressure_exponent = of_tire.pressure_exponent;
}

const char* name_of_law(const Specimen& specimen) { return specimen.constant_rrc ? "constant_rrc" : "combined"; }

std::string write_identified(const Specimen& specimen, Base first, Base last) {
  std::string text;
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
    const Identified& number = specimen.base[i];
    text += fmt::format("{0} = {1:.10g}\n{0}_sd = {2:.6g}\n", number.key, number.nominal, number.sd);
  }
  return text;
}

std::string write_tire(const Specimen& specimen) {
  std::string text = "format = \"rollrig-tire/1\"\nname = \"specimen\"\n\n[geometry]\n";
  text += fmt::format("outer_diameter_m = {:.10g}\nsection_width_m = {:.10g}\nrim_diameter_m = {:.10g}\n",
                      specimen.outer_diameter_m, specimen.section_width_m, specimen.rim_diameter_m);
  text += fmt::format("mass_kg = {:.10g}\nwheel_mass_kg = {:.10g}\nspin_inertia_kg_m2 = {:.10g}\n",
                      specimen.tire_mass_kg, specimen.wheel_mass_kg, specimen.spin_inertia_kg_m2);
  if (specimen.constant_rrc) {
    return text + "\n[constant]\n" + write_identified(specimen, Base::kRrc, Base::kRrc);
  }
  text += fmt::format("\n[stiffness]\nvertical_N_per_m = {:.10g}\nvertical_damping_N_s_per_m = 300\n",
                      specimen.vertical_N_per_m);
  text += "slip_stiffness_N = 75000\nrelaxation_length_m = 0.3\n\n[rolling_resistance]\n";
  text += fmt::format("reference_load_N = {:.10g}\nreference_pressure_kPa = {:.10g}\n", specimen.reference_load_N,
                      specimen.reference_pressure_kPa);
  text += fmt::format("reference_drum_diameter_m = 2\npressure_exponent = {:.10g}\n", specimen.pressure_exponent);
  text += write_identified(specimen, Base::kA0, Base::kB1);
  text += "\n[thermal]\nroad_share_of_z = 0.5\n";
  text += write_identified(specimen, Base::kC, Base::kF);
  return text;
}

}  // namespace rollrig::generator
