#include "api/road_load_options.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "api/option_range.h"
#include "rollrig/error.h"
#include "sim/core/units.h"

namespace rollrig {
namespace {

// Assumed: beyond what is built, or measured in a test.
// A motorcycle with its rider has 150 kg, a heavy dump truck 6e5 kg. A smaller mass is one in t.
constexpr OptionRange kMass{"--mass", 100.0, 1e6, "kg"};
constexpr OptionRange kRotatingMass{"--rotating-mass", 0.0, 1e6, "kg"};
constexpr OptionRange kCorrectedMass{"--corrected-mass", 100.0, 1e6, "kg"};
constexpr OptionRange kDragArea{"--drag-area", 0.01, 1000.0, "m2"};
constexpr OptionRange kWheelRadius{"--wheel-radius", 0.1, 2.0, "m"};
constexpr OptionRange kYawDegree{"--yaw-degree", 0.0, 4.0, ""};
constexpr OptionRange kReferenceTemperature{"--reference-temperature", -50.0, 60.0, "degC"};
constexpr OptionRange kReferencePressure{"--reference-pressure", 50.0, 110.0, "kPa"};
constexpr OptionRange kRollingFall{"--rolling-coefficient-temperature", 0.0, 0.05, "per K"};
constexpr OptionRange kSpeedFrom{"--speed-from", 0.0, 500.0, "km/h"};
constexpr OptionRange kSpeedTo{"--speed-to", 1.0, 500.0, "km/h"};
constexpr OptionRange kBinWidth{"--bin-width", 1.0, 50.0, "km/h"};
constexpr OptionRange kWidth{"--width", 0.5, 5.0, "m"};
constexpr OptionRange kHeight{"--height", 0.5, 5.0, "m"};
constexpr OptionRange kClassRrc{"--rrc", 1.0, 30.0, "N/kN"};

InputError option_error(const std::string& what, const char* option, const std::string& value,
                        const std::string& allowed) {
  return InputError({what, "command line", 0, option, value, allowed, ""});
}

void require_if_given(const OptionRange& range, const std::optional<double>& value) {
  if (value.has_value()) require_within(range, *value);
}

void require_masses(const std::optional<double>& mass_kg, const std::optional<double>& rotating_mass_kg) {
  require_if_given(kMass, mass_kg);
  require_if_given(kRotatingMass, rotating_mass_kg);
  if (!rotating_mass_kg.has_value()) return;
  const std::string given = fmt::format("{:.6g}", *rotating_mass_kg);
  if (!mass_kg.has_value()) {
    throw option_error("the rotating mass is given without the mass", "--rotating-mass", given,
                       "--mass <kg> beside it, or none of them");
  }
  if (*rotating_mass_kg <= *mass_kg) return;
  throw option_error("more mass rotates than the vehicle has", "--rotating-mass", given,
                     fmt::format("at most --mass, {:.6g} kg; of cars about 3 % of it", *mass_kg));
}

void require_reference(double temperature_K, const std::optional<double>& pressure_Pa, double rolling_fall_per_K) {
  require_within(kReferenceTemperature, temperature_K - kZeroCelsius_K);
  if (pressure_Pa.has_value()) require_within(kReferencePressure, 1e-3 * *pressure_Pa);
  require_within(kRollingFall, rolling_fall_per_K);
}

/// An infinite upper limit is none.
void require_speeds(double from_m_s, double to_m_s) {
  require_within(kSpeedFrom, kKmhPerMs * from_m_s);
  if (to_m_s == std::numeric_limits<double>::infinity()) return;
  require_within(kSpeedTo, kKmhPerMs * to_m_s);
  if (to_m_s > from_m_s) return;
  throw option_error("--speed-to is not above --speed-from", "--speed-to", fmt::format("{:.6g}", kKmhPerMs * to_m_s),
                     fmt::format("more than {:.6g}", kKmhPerMs * from_m_s));
}

void require_bounds(const RoadLoadBounds& bounds) {
  constexpr const char* kNames[]{"A", "B", "C"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = bounds.lower[i];
    const double to = bounds.upper[i];
    const auto refuse = [&](const std::string& what, const std::string& allowed) {
      throw option_error(what, "--bounds", fmt::format("{:g}:{:g} in SI units", from, to), allowed);
    };
    if (std::isnan(from) || std::isnan(to)) {
      refuse(fmt::format("a bound of {} is not a number", kNames[i]), "a number, or infinite for no bound");
    }
    if (from > to) refuse(fmt::format("the bounds of {} have their ends swapped", kNames[i]), "from <= to");
    if (from == RoadLoadBounds::kNone || to == -RoadLoadBounds::kNone) {
      refuse(fmt::format("no number is within the bounds of {}", kNames[i]), "from < infinity, to > -infinity");
    }
  }
}

void require_numbers(const std::array<double, 3>& target) {
  for (const double value : target) {
    if (std::isfinite(value)) continue;
    throw option_error("a coefficient of the target is no number", "--target", fmt::format("{:g}", value),
                       "three numbers");
  }
}

}  // namespace

void require_valid(const RoadLoadFitOptions& options) {
  require_masses(options.mass_kg, options.rotating_mass_kg);
  require_if_given(kDragArea, options.drag_area_m2);
  require_reference(options.reference_temperature_K, options.reference_pressure_Pa, options.rolling_fall_per_K);
  require_speeds(options.speed_from_m_s, options.speed_to_m_s);
  require_within(kBinWidth, kKmhPerMs * options.bin_width_m_s);
  if (options.bounds.has_value()) require_bounds(*options.bounds);
  if (options.target.has_value()) require_numbers(*options.target);
}

void require_valid(const RoadLoadProcedureOptions& options) {
  require_masses(options.mass_kg, options.rotating_mass_kg);
  require_if_given(kCorrectedMass, options.corrected_to_mass_kg);
  require_reference(options.reference_temperature_K, options.reference_pressure_Pa, options.rolling_fall_per_K);
  require_speeds(options.speed_from_m_s, options.speed_to_m_s);
  require_within(kYawDegree, options.yaw_degree);
  require_if_given(kWheelRadius, options.wheel_radius_m);
  if (options.wheel_radius_m.has_value() && options.kind != RoadLoadProcedureKind::kTorqueMeter) {
    throw option_error("--wheel-radius has no meaning with another method than torque-meter", "--wheel-radius",
                       fmt::format("{:g}", *options.wheel_radius_m), "--method torque-meter beside it");
  }
  if (options.yaw_degree != RoadLoadProcedureOptions().yaw_degree && options.kind != RoadLoadProcedureKind::kJ2263) {
    throw option_error("--yaw-degree has no meaning with another method than j2263", "--yaw-degree",
                       fmt::format("{}", options.yaw_degree), "--method j2263 beside it");
  }
}

void require_valid(const DefaultRoadLoadOptions& options) {
  require_within(kMass, options.mass_kg);
  require_within(kWidth, options.width_m);
  require_within(kHeight, options.height_m);
  if (options.tire_class.empty() && options.rrc_N_per_kN == 0.0) return;
  if (options.tire_class.empty()) {
    throw option_error("a rolling resistance coefficient alone does not tell the class of tires", "--rrc",
                       fmt::format("{:g}", options.rrc_N_per_kN), "--tire-class C1, C2 or C3 beside it");
  }
  if (options.rrc_N_per_kN == 0.0) {
    throw option_error("a class of tires alone does not tell the class of rolling resistance", "--tire-class",
                       options.tire_class, "--rrc <N/kN> beside it");
  }
  require_within(kClassRrc, options.rrc_N_per_kN);
}

}  // namespace rollrig
