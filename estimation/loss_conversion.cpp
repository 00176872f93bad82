#include "estimation/loss_conversion.h"

#include <fmt/format.h>

#include <cmath>

#include "models/tire/conversion_laws.h"
#include "models/tire/drum_curvature.h"
#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

std::string drum_text(double curvature_per_m) {
  return curvature_per_m == 0.0 ? "flat" : fmt::format("{:.4g} m", 2.0 / curvature_per_m);
}

void add_factor(ConversionFactors& conversion, ConversionFactor factor) {
  conversion.force_factor *= factor.factor;
  conversion.factors.push_back(std::move(factor));
}

void add_drum(ConversionFactors& conversion, double from_per_m, double to_per_m, double tire_diameter_m) {
  if (from_per_m == to_per_m) return;
  add_factor(conversion,
             {fmt::format("drum, tire {:.4g} m", tire_diameter_m), "(3.1)", drum_text(from_per_m), drum_text(to_per_m),
              models::calc_drum_correction(from_per_m, to_per_m, tire_diameter_m / 2.0)});
}

void add_tire_diameter(double from_m, double to_m, double exponent, ConversionFactors& conversion) {
  add_factor(conversion,
             {fmt::format("tire diameter, exponent {:.3g}", exponent), "(2.1)", fmt::format("{:.4g} m", from_m),
              fmt::format("{:.4g} m", to_m), models::calc_tire_diameter_factor(from_m, to_m, exponent)});
  if (exponent != models::kDiameterExponent) return;
  conversion.warnings.push_back(fmt::format(
      "publications differ on the exponent of the tire diameter: with {:.2g} in place of {:.3g}, the factor "
      "is {:.5g} (docs/convert.md)",
      models::kOtherDiameterExponent, exponent,
      models::calc_tire_diameter_factor(from_m, to_m, models::kOtherDiameterExponent)));
}

void add_drum_and_tire(const LossConditions& from, const LossConditions& to, double diameter_exponent,
                       ConversionFactors& conversion) {
  const bool drums = from.drum_curvature_per_m.has_value() && to.drum_curvature_per_m.has_value();
  const bool tires = from.tire_diameter_m.has_value() && to.tire_diameter_m.has_value();
  if (drums && !from.tire_diameter_m.has_value()) {
    throw InputError({"a drum is converted by (3.1), which takes the tire's diameter", "command line", 0,
                      "--tire-diameter", "", "--tire <name or path> or --tire-diameter <m>", ""});
  }
  const bool tire_changes = tires && *from.tire_diameter_m != *to.tire_diameter_m;
  if (drums) {
    add_drum(conversion, *from.drum_curvature_per_m, tire_changes ? 0.0 : *to.drum_curvature_per_m,
             *from.tire_diameter_m);
  }
  if (!tire_changes) return;
  add_tire_diameter(*from.tire_diameter_m, *to.tire_diameter_m, diameter_exponent, conversion);
  if (drums) add_drum(conversion, 0.0, *to.drum_curvature_per_m, *to.tire_diameter_m);
}

void add_pressure(double from_Pa, double to_Pa, double exponent, ConversionFactors& conversion) {
  constexpr double kLowest = 0.3;  // §2.2.2.3
  constexpr double kHighest = 0.5;
  if (from_Pa == to_Pa) return;
  add_factor(conversion,
             {fmt::format("pressure, exponent {:.3g}", exponent), "(3.4)", fmt::format("{:.4g} kPa", from_Pa / 1e3),
              fmt::format("{:.4g} kPa", to_Pa / 1e3), models::calc_pressure_factor(to_Pa, from_Pa, exponent)});
  if (exponent >= kLowest && exponent <= kHighest) return;
  conversion.warnings.push_back(
      fmt::format("the pressure exponent {:.3g} is outside 0.3 to 0.5, where tests found it (§2.2.2.3)", exponent));
}

double require_ambient_correction(double ambient_K, double coefficient_per_K, const char* option) {
  const double correction = models::calc_ambient_correction(ambient_K, coefficient_per_K);
  if (correction > 0.0) return correction;
  throw InputError({"air so cold that ISO 28580's correction has no sense", "command line", 0, option,
                    fmt::format("{:.4g} degC", ambient_K - kZeroCelsius_K),
                    fmt::format("above {:.4g} degC; valid from 20 to 30 degC",
                                models::kReferenceAmbient_K - kZeroCelsius_K - 1.0 / coefficient_per_K),
                    ""});
}

void add_ambient(double from_K, double to_K, double coefficient_per_K, ConversionFactors& conversion) {
  const double from = require_ambient_correction(from_K, coefficient_per_K, "--from-ambient");
  const double to = require_ambient_correction(to_K, coefficient_per_K, "--to-ambient");
  if (from_K == to_K) return;
  add_factor(conversion, {fmt::format("air, K_t {:.3g}/degC", coefficient_per_K), "ISO 28580",
                          fmt::format("{:.4g} degC", from_K - kZeroCelsius_K),
                          fmt::format("{:.4g} degC", to_K - kZeroCelsius_K), from / to});
  for (const double ambient_K : {from_K, to_K}) {
    if (models::is_ambient_correction_valid(ambient_K)) continue;
    conversion.warnings.push_back(
        fmt::format("air of {:.4g} degC is outside the 20 to 30 degC for which ISO 28580 gives its correction",
                    ambient_K - kZeroCelsius_K));
  }
}

void add_load(double from_N, double to_N, double exponent, ConversionFactors& conversion) {
  if (from_N == to_N) return;
  add_factor(conversion, {fmt::format("load, exponent {:.4g}", exponent), "(3.5)", fmt::format("{:.5g} N", from_N),
                          fmt::format("{:.5g} N", to_N), std::pow(to_N / from_N, exponent)});
}

}  // namespace

ConversionFactors convert_loss(const LossConditions& from, const LossConditions& to, const ConversionLaws& laws) {
  ConversionFactors conversion;
  add_drum_and_tire(from, to, laws.diameter_exponent, conversion);
  if (from.pressure_Pa.has_value() && to.pressure_Pa.has_value()) {
    add_pressure(*from.pressure_Pa, *to.pressure_Pa, laws.pressure_exponent, conversion);
  }
  if (from.ambient_K.has_value() && to.ambient_K.has_value()) {
    add_ambient(*from.ambient_K, *to.ambient_K, laws.ambient_coefficient_per_K, conversion);
  }
  if (from.load_N.has_value() && to.load_N.has_value()) {
    add_load(*from.load_N, *to.load_N, laws.load_exponent, conversion);
  }
  return conversion;
}

}  // namespace rollrig::estimation
