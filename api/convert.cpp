#include "rollrig/convert.h"

#include <fmt/format.h>

#include <cmath>

#include "estimation/loss_conversion.h"
#include "models/tire/tire_file.h"
#include "sim/core/assets.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig {
namespace {

/// An option and its value in SI units, if it has one.
using Given = std::pair<const char*, std::optional<double>>;

/// Refuses values outside a range. `key` ends in the unit in which messages show them.
void require_in_range(const Range& range_SI, const char* key, const char* allowed, const std::vector<Given>& all) {
  for (const auto& [option, value_SI] : all) {
    if (!value_SI.has_value() || (std::isfinite(*value_SI) && range_SI.contains(*value_SI))) continue;
    throw InputError({fmt::format("{} is out of range", option), "command line", 0, option,
                      fmt::format("{:g}", unit_of_key(key).from_si(*value_SI)), allowed, ""});
  }
}

void require_both(const Given& from, const Given& to) {
  if (from.second.has_value() == to.second.has_value()) return;
  const auto [given, missing] =
      from.second.has_value() ? std::pair(from.first, to.first) : std::pair(to.first, from.first);
  throw InputError(
      {fmt::format("{} is given without {}", given, missing), "command line", 0, missing, "", "both, or neither", ""});
}

/// Refuses an exponent or coefficient whose condition is not given.
void require_condition(const Given& number, const Given& condition) {
  if (!number.second.has_value() || condition.second.has_value()) return;
  throw InputError({fmt::format("{} has no effect without {}", number.first, condition.first), "command line", 0,
                    number.first, fmt::format("{:g}", *number.second),
                    fmt::format("together with {}, or not at all", condition.first), ""});
}

/// Before the tire's own exponent is put in, which is there in any case.
void require_conditions(const ConversionInput& input) {
  const LossConditions& to = input.to;
  require_condition({"--pressure-exponent", input.pressure_exponent}, {"--to-pressure", to.pressure_Pa});
  require_condition({"--load-exponent", input.load_exponent}, {"--to-load", to.load_N});
  require_condition({"--diameter-exponent", input.diameter_exponent}, {"--to-tire-diameter", to.tire_diameter_m});
  require_condition({"--ambient-coefficient", input.ambient_coefficient_per_K}, {"--to-ambient", to.ambient_K});
}

void check_conversion(const ConversionInput& input) {
  const LossConditions& from = input.from;
  const LossConditions& to = input.to;
  const Given drum{"--from-drum", from.drum_curvature_per_m}, to_drum{"--to-drum", to.drum_curvature_per_m};
  const Given tire{"--tire-diameter", from.tire_diameter_m}, to_tire{"--to-tire-diameter", to.tire_diameter_m};
  const Given pressure{"--from-pressure", from.pressure_Pa}, to_pressure{"--to-pressure", to.pressure_Pa};
  const Given air{"--from-ambient", from.ambient_K}, to_air{"--to-ambient", to.ambient_K};
  const Given load{"--load", from.load_N}, to_load{"--to-load", to.load_N};
  const Range air_K = between(-60.0 + kZeroCelsius_K, 80.0 + kZeroCelsius_K);
  // Assumed: far beyond all that is built, as the limits of tire and rig files, so that no factor overflows.
  require_in_range(between(1e-3, 1e6), "force_N", "0.001 to 1000000 N", {{"--force", input.loss.force_N}});
  require_in_range(between(1.0, 1e6), "load_N", "1 to 1000000 N", {load, to_load});
  require_in_range(between(1e-3, 1e3), "rrc", "0.001 to 1000 N/kN", {{"--rrc", input.loss.rrc_N_per_kN}});
  require_in_range(between(0.1, 10.0), "diameter_m", "0.1 to 10 m", {tire, to_tire});
  require_in_range(between(0.0, 20.0), "curvature_per_m", "0 to 20 1/m: a diameter of 0.1 m or more, or flat",
                   {drum, to_drum});
  require_in_range(between(1e3, 1e7), "pressure_kPa", "1 to 10000 kPa, gauge", {pressure, to_pressure});
  require_in_range(air_K, "ambient_degC", "a number >= -60 and <= 80 in degC", {air, to_air});
  require_in_range(between(-1.0, 3.0), "exponent", "-1 to 3", {{"--pressure-exponent", input.pressure_exponent}});
  require_in_range(between(0.0, 3.0), "exponent", "0 to 3",
                   {{"--load-exponent", input.load_exponent}, {"--diameter-exponent", input.diameter_exponent}});
  require_in_range(between(0.0, 0.02), "coefficient", "0 to 0.02 in 1/degC",
                   {{"--ambient-coefficient", input.ambient_coefficient_per_K}});
  if (input.loss.force_N.has_value() == input.loss.rrc_N_per_kN.has_value()) {
    throw InputError(
        {"a loss is given once", "command line", 0, "--force", "", "either --force <N> or --rrc <N/kN>", ""});
  }
  require_both(drum, to_drum);
  require_both(pressure, to_pressure);
  require_both(air, to_air);
  if (to.load_N.has_value()) require_both(load, to_load);
  if (to.tire_diameter_m.has_value()) require_both(tire, to_tire);
}

/// What the tire says where the input does not say it.
void apply_tire(ConversionInput& input) {
  if (input.tire.empty()) return;
  const models::TireFile tire = models::read_tire(read_config(find_asset("tires", input.tire)));
  if (!input.from.tire_diameter_m.has_value()) input.from.tire_diameter_m = tire.values.geometry.outer_diameter_m;
  if (!input.pressure_exponent.has_value() && tire.has_rolling_resistance) {
    input.pressure_exponent = tire.values.rolling_resistance.pressure_exponent;
  }
}

/// The loss before and after. RRc goes with the force over the load.
void apply_factor(const ConversionInput& input, ConvertedLoss& converted) {
  const std::optional<double> load_N = input.from.load_N;
  const double rrc_factor = converted.force_factor * (load_N ? *load_N / input.to.load_N.value_or(*load_N) : 1.0);
  Loss& from = converted.given;
  from = input.loss;
  if (load_N.has_value() && from.force_N.has_value()) from.rrc_N_per_kN = 1e3 * *from.force_N / *load_N;
  if (load_N.has_value() && !from.force_N.has_value()) from.force_N = 1e-3 * *from.rrc_N_per_kN * *load_N;
  if (from.force_N.has_value()) converted.result.force_N = *from.force_N * converted.force_factor;
  if (from.rrc_N_per_kN.has_value()) converted.result.rrc_N_per_kN = *from.rrc_N_per_kN * rrc_factor;
}

Json make_loss_json(const Loss& loss) {
  Json json = Json::object();
  if (loss.force_N.has_value()) json["force_N"] = *loss.force_N;
  if (loss.rrc_N_per_kN.has_value()) json["rrc_N_per_kN"] = *loss.rrc_N_per_kN;
  return json;
}

Json make_conversion_json(const ConvertedLoss& converted) {
  Json json = {{"format", "rollrig-conversion/1"}, {"given", make_loss_json(converted.given)}};
  json["factors"] = Json::array();
  for (const auto& [name, equation, from, to, factor] : converted.factors) {
    json["factors"].push_back({{"name", name}, {"equation", equation}, {"from", from}, {"to", to}, {"factor", factor}});
  }
  json["force_factor"] = converted.force_factor;
  json["result"] = make_loss_json(converted.result);
  if (!converted.warnings.empty()) json["warnings"] = converted.warnings;
  return json;
}

std::string format_loss(const Loss& loss) {
  std::string text;
  if (loss.force_N.has_value()) text = fmt::format("{:.5g} N", *loss.force_N);
  if (!loss.rrc_N_per_kN.has_value()) return text;
  return text + fmt::format("{}{:.5g} N/kN", text.empty() ? "" : ", ", *loss.rrc_N_per_kN);
}

std::string format_conversion(const ConvertedLoss& converted) {
  Table table{"", {"factor", "equation", "from", "to", "of the force"}, {}};
  for (const auto& [name, equation, from, to, factor] : converted.factors) {
    table.rows.push_back({name, equation, from, to, fmt::format("{:.4f}", factor)});
  }
  table.rows.push_back({"product", "", "", "", fmt::format("{:.4f}", converted.force_factor)});
  const Table result{"", {}, {{"converted", format_loss(converted.result)}}};
  return "convert   " + format_loss(converted.given) + "\n" + format_tables({table, result}) +
         format_warnings(converted.warnings);
}

}  // namespace

ConvertedLoss convert_loss(const ConversionInput& given) {
  ConversionInput input = given;
  require_conditions(input);
  apply_tire(input);
  check_conversion(input);
  const estimation::ConversionLaws usual;
  ConvertedLoss converted;
  static_cast<ConversionFactors&>(converted) = estimation::convert_loss(
      input.from, input.to,
      {input.pressure_exponent.value_or(usual.pressure_exponent), input.load_exponent.value_or(usual.load_exponent),
       input.diameter_exponent.value_or(usual.diameter_exponent),
       input.ambient_coefficient_per_K.value_or(usual.ambient_coefficient_per_K)});
  apply_factor(input, converted);
  converted.text = format_conversion(converted);
  converted.json = to_text(make_conversion_json(converted));
  return converted;
}

}  // namespace rollrig
