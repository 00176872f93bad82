#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "estimation/loss_conversion.h"
#include "models/tire/tire_file.h"
#include "report/text.h"
#include "sim/core/assets.h"
#include "sim/core/config.h"
#include "sim/core/file_io.h"
#include "sim/core/schema.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

/// As given, in the units of the options.
struct Side {
  std::string drum;
  std::optional<double> tire_diameter_m, pressure_kPa, ambient_degC, load_N;
};

struct Options {
  std::optional<double> force_N, rrc_N_per_kN;
  std::string tire;
  Side from, to;
  estimation::ConversionExponents exponents;
  std::string json;
};

void require_in(const Range& range, const std::optional<double>& value, const std::string& option,
                const std::string& unit) {
  if (!value.has_value() || (std::isfinite(*value) && range.contains(*value))) return;
  throw usage_error(option + " is out of range", option, fmt::format("{:g}", *value),
                    fmt::format("a number {} in {}", range.to_string(), unit));
}

/// 1/R of a diameter in m, 0 of "flat".
std::optional<double> read_curvature(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  if (text == "flat") return 0.0;
  const std::optional<double> diameter_m = parse_number(text);
  if (!diameter_m.has_value() || *diameter_m <= 0.0) {
    throw usage_error(fmt::format("'{}' is not a drum", text), option, text, "a diameter in m, > 0, or flat");
  }
  return 2.0 / *diameter_m;
}

void require_both(bool from_given, bool to_given, const std::string& from, const std::string& to) {
  if (from_given == to_given) return;
  const std::string& missing = from_given ? to : from;
  throw usage_error(fmt::format("{} is given without {}", from_given ? from : to, missing), missing, "",
                    "both, or neither");
}

/// The tire of --tire, with its diameter and its pressure exponent; those given by hand come first.
void apply_tire(Options& options, bool exponent_given) {
  if (options.tire.empty()) return;
  const models::TireFile tire = models::read_tire(read_config(find_asset("tires", options.tire)));
  if (!options.from.tire_diameter_m.has_value()) options.from.tire_diameter_m = tire.values.geometry.outer_diameter_m;
  if (!exponent_given && tire.has_rolling_resistance) {
    options.exponents.pressure = tire.values.rolling_resistance.pressure_exponent;
  }
}

void check(const Options& options) {
  if (options.force_N.has_value() == options.rrc_N_per_kN.has_value()) {
    throw usage_error("a loss is given once", "--force", "", "either --force <N> or --rrc <N/kN>");
  }
  require_in(positive(), options.force_N, "--force", "N");
  require_in(positive(), options.rrc_N_per_kN, "--rrc", "N/kN");
  require_in(between(-1.0, 3.0), options.exponents.pressure, "--pressure-exponent", "-");
  require_in(between(0.0, 3.0), options.exponents.load, "--load-exponent", "-");
  require_in(positive(), options.from.tire_diameter_m, "--tire-diameter", "m");
  require_in(positive(), options.to.tire_diameter_m, "--to-tire-diameter", "m");
  for (const auto& [side, name] : {std::pair(&options.from, "from"), std::pair(&options.to, "to")}) {
    const std::string prefix = std::string("--") + name + "-";
    require_in(positive(), side->pressure_kPa, prefix + "pressure", "kPa, gauge");
    require_in(between(-60.0, 80.0), side->ambient_degC, prefix + "ambient", "degC");
    require_in(positive(), side->load_N, std::string(name) == "to" ? "--to-load" : "--load", "N");
  }
  const Side& from = options.from;
  const Side& to = options.to;
  require_both(!from.drum.empty(), !to.drum.empty(), "--from-drum", "--to-drum");
  require_both(from.pressure_kPa.has_value(), to.pressure_kPa.has_value(), "--from-pressure", "--to-pressure");
  require_both(from.ambient_degC.has_value(), to.ambient_degC.has_value(), "--from-ambient", "--to-ambient");
  if (to.load_N.has_value()) require_both(from.load_N.has_value(), true, "--load", "--to-load");
  if (to.tire_diameter_m.has_value()) {
    require_both(from.tire_diameter_m.has_value(), true, "--tire-diameter", "--to-tire-diameter");
  }
}

estimation::LossConditions make_conditions(const Side& side, const std::string& drum_option) {
  estimation::LossConditions conditions;
  conditions.drum_curvature_per_m = read_curvature(side.drum, drum_option);
  conditions.tire_diameter_m = side.tire_diameter_m;
  if (side.pressure_kPa.has_value()) conditions.pressure_Pa = 1e3 * *side.pressure_kPa;
  if (side.ambient_degC.has_value()) conditions.ambient_K = *side.ambient_degC + kZeroCelsius_K;
  conditions.load_N = side.load_N;
  return conditions;
}

/// A loss as force, as RRc, or as both where the load is known.
struct Loss {
  std::optional<double> force_N, rrc_N_per_kN;
};

/// The loss before and after. RRc goes with the force over the load.
std::pair<Loss, Loss> apply_conversion(const Options& options, double force_factor) {
  const std::optional<double> load_N = options.from.load_N;
  const std::optional<double> to_load_N = options.to.load_N.has_value() ? options.to.load_N : load_N;
  const double rrc_factor = load_N.has_value() ? force_factor * *load_N / *to_load_N : force_factor;
  Loss from{options.force_N, options.rrc_N_per_kN};
  if (load_N.has_value() && from.force_N.has_value()) from.rrc_N_per_kN = 1e3 * *from.force_N / *load_N;
  if (load_N.has_value() && !from.force_N.has_value()) from.force_N = 1e-3 * *from.rrc_N_per_kN * *load_N;
  Loss to;
  if (from.force_N.has_value()) to.force_N = *from.force_N * force_factor;
  if (from.rrc_N_per_kN.has_value()) to.rrc_N_per_kN = *from.rrc_N_per_kN * rrc_factor;
  return {from, to};
}

Json to_json(const Loss& loss) {
  Json json = Json::object();
  if (loss.force_N.has_value()) json["force_N"] = *loss.force_N;
  if (loss.rrc_N_per_kN.has_value()) json["rrc_N_per_kN"] = *loss.rrc_N_per_kN;
  return json;
}

Json make_json(const estimation::LossConversion& conversion, const Loss& from, const Loss& to) {
  Json json = {{"format", "rollrig-conversion/1"}, {"given", to_json(from)}, {"factors", Json::array()}};
  for (const estimation::ConversionFactor& factor : conversion.factors) {
    json["factors"].push_back({{"name", factor.name},
                               {"equation", factor.equation},
                               {"from", factor.from},
                               {"to", factor.to},
                               {"factor", factor.factor}});
  }
  json["force_factor"] = conversion.force_factor;
  json["result"] = to_json(to);
  if (!conversion.warnings.empty()) json["warnings"] = conversion.warnings;
  return json;
}

std::string describe(const Loss& loss) {
  std::string text;
  if (loss.force_N.has_value()) text += fmt::format("{:.5g} N", *loss.force_N);
  if (loss.rrc_N_per_kN.has_value()) {
    text += fmt::format("{}{:.5g} N/kN", text.empty() ? "" : ", ", *loss.rrc_N_per_kN);
  }
  return text;
}

std::string format_conversion(const estimation::LossConversion& conversion, const Loss& from, const Loss& to) {
  scenarios::ResultTable table{"", {"factor", "equation", "from", "to", "of the force"}, {}};
  for (const estimation::ConversionFactor& factor : conversion.factors) {
    table.rows.push_back({factor.name, factor.equation, factor.from, factor.to, fmt::format("{:.4f}", factor.factor)});
  }
  table.rows.push_back({"product", "", "", "", fmt::format("{:.4f}", conversion.force_factor)});
  std::string text = "convert   " + describe(from) + "\n" + report::format_table(table);
  text += fmt::format("  converted  {}\n", describe(to));
  for (const std::string& warning : conversion.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

int convert_command(Options options, bool exponent_given) {
  apply_tire(options, exponent_given);
  check(options);
  estimation::LossConditions from = make_conditions(options.from, "--from-drum");
  estimation::LossConditions to = make_conditions(options.to, "--to-drum");
  const OutputFiles files({{"--json", options.json}});
  const estimation::LossConversion conversion = estimation::convert_loss(from, to, options.exponents);
  const auto [given, result] = apply_conversion(options, conversion.force_factor);
  if (!options.json.empty()) write_output(options.json, make_json(conversion, given, result).dump(2) + "\n");
  if (options.json != "-") std::cout << format_conversion(conversion, given, result);
  return kDone;
}

}  // namespace

void add_convert_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "convert", "Take a measured loss to another drum, tire diameter, pressure, temperature of the air or load");
  auto options = std::make_shared<Options>();
  Side& from = options->from;
  Side& to = options->to;
  command->add_option("--force", options->force_N, "Measured loss in N");
  command->add_option("--rrc", options->rrc_N_per_kN, "Measured loss in N/kN");
  command->add_option("--load", from.load_N, "Load in N, to give both force and RRc");
  command->add_option("--to-load", to.load_N, "Load to convert to in N; needs --load");
  command->add_option("--from-drum", from.drum, "Diameter of the drum in m, or flat");
  command->add_option("--to-drum", to.drum, "Diameter of the drum to convert to in m, or flat");
  command->add_option("--tire", options->tire, "Name under assets/tires, or a path: its diameter, pressure exponent");
  command->add_option("--tire-diameter", from.tire_diameter_m, "Outer diameter of the tire in m");
  command->add_option("--to-tire-diameter", to.tire_diameter_m, "Outer diameter of the tire to convert to in m");
  command->add_option("--from-pressure", from.pressure_kPa, "Gauge pressure in kPa");
  command->add_option("--to-pressure", to.pressure_kPa, "Gauge pressure to convert to in kPa");
  command->add_option("--from-ambient", from.ambient_degC, "Temperature of the air in degC");
  command->add_option("--to-ambient", to.ambient_degC, "Temperature of the air to convert to in degC");
  CLI::Option* exponent = command->add_option("--pressure-exponent", options->exponents.pressure,
                                              "a of (p/p_ref)^-a [the tire's, else 0.4]");
  command->add_option("--load-exponent", options->exponents.load, "Exponent of the force over load [1]");
  command->add_option("--json", options->json, "File for the result, - for standard output");
  command->callback([options, exponent, &action] {
    const bool exponent_given = exponent->count() > 0;
    action = [options, exponent_given] { return convert_command(*options, exponent_given); };
  });
}

}  // namespace rollrig::cli
