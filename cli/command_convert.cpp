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

/// A loss as force, as RRc, or as both where the load is known.
struct Loss {
  std::optional<double> force_N, rrc_N_per_kN;
};

struct Options {
  Loss given;
  std::string tire;
  estimation::LossConditions from, to;
  estimation::ConversionExponents exponents;
  std::string json;
};

/// How a number is given: what is allowed, the unit, and that unit in SI.
struct Given {
  Range range;
  const char* unit;
  double factor = 1.0;
  double offset_SI = 0.0;
};

template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& option, Number& number_SI, const Given& given,
                        const char* doc) {
  const auto set = [&number_SI, option, given](const double& value) {
    if (!std::isfinite(value) || !given.range.contains(value)) {
      throw usage_error(option + " is out of range", option, fmt::format("{:g}", value),
                        fmt::format("a number {} in {}", given.range.to_string(), given.unit));
    }
    number_SI = given.factor * value + given.offset_SI;
  };
  return command.add_option_function<double>(option, set, doc);
}

/// 1/R of a diameter in m, 0 of "flat".
void add_drum(CLI::App& command, const std::string& option, std::optional<double>& curvature_per_m, const char* doc) {
  const auto set = [&curvature_per_m, option](const std::string& text) {
    const std::optional<double> diameter_m = parse_number(text);
    if (text != "flat" && !(diameter_m.has_value() && *diameter_m > 0.0)) {
      throw usage_error(fmt::format("'{}' is not a drum", text), option, text, "a diameter in m, > 0, or flat");
    }
    curvature_per_m = text == "flat" ? 0.0 : 2.0 / *diameter_m;
  };
  command.add_option_function<std::string>(option, set, doc);
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
  if (options.given.force_N.has_value() == options.given.rrc_N_per_kN.has_value()) {
    throw usage_error("a loss is given once", "--force", "", "either --force <N> or --rrc <N/kN>");
  }
  const estimation::LossConditions& from = options.from;
  const estimation::LossConditions& to = options.to;
  require_both(from.drum_curvature_per_m.has_value(), to.drum_curvature_per_m.has_value(), "--from-drum", "--to-drum");
  require_both(from.pressure_Pa.has_value(), to.pressure_Pa.has_value(), "--from-pressure", "--to-pressure");
  require_both(from.ambient_K.has_value(), to.ambient_K.has_value(), "--from-ambient", "--to-ambient");
  if (to.load_N.has_value()) require_both(from.load_N.has_value(), true, "--load", "--to-load");
  if (to.tire_diameter_m.has_value()) {
    require_both(from.tire_diameter_m.has_value(), true, "--tire-diameter", "--to-tire-diameter");
  }
}

/// The loss before and after. RRc goes with the force over the load.
std::pair<Loss, Loss> apply_conversion(const Options& options, double force_factor) {
  const std::optional<double> load_N = options.from.load_N;
  const std::optional<double> to_load_N = options.to.load_N.has_value() ? options.to.load_N : load_N;
  const double rrc_factor = load_N.has_value() ? force_factor * *load_N / *to_load_N : force_factor;
  Loss from = options.given;
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
  const OutputFiles files({{"--json", options.json}});
  const estimation::LossConversion conversion = estimation::convert_loss(options.from, options.to, options.exponents);
  const auto [given, result] = apply_conversion(options, conversion.force_factor);
  if (!options.json.empty()) write_output(options.json, to_text(make_json(conversion, given, result)));
  if (options.json != "-") std::cout << format_conversion(conversion, given, result);
  return kDone;
}

}  // namespace

void add_convert_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "convert", "Take a measured loss to another drum, tire diameter, pressure, temperature of the air or load");
  auto options = std::make_shared<Options>();
  estimation::LossConditions& from = options->from;
  estimation::LossConditions& to = options->to;
  const Given newtons{positive(), "N"}, meters{positive(), "m"}, gauge{positive(), "kPa, gauge", 1e3};
  const Given air{between(-60.0, 80.0), "degC", 1.0, kZeroCelsius_K};
  add_number(*command, "--force", options->given.force_N, newtons, "Measured loss in N");
  add_number(*command, "--rrc", options->given.rrc_N_per_kN, {positive(), "N/kN"}, "Measured loss in N/kN");
  add_number(*command, "--load", from.load_N, newtons, "Load in N, to give both force and RRc");
  add_number(*command, "--to-load", to.load_N, newtons, "Load to convert to in N; needs --load");
  add_drum(*command, "--from-drum", from.drum_curvature_per_m, "Diameter of the drum in m, or flat");
  add_drum(*command, "--to-drum", to.drum_curvature_per_m, "Diameter of the drum to convert to in m, or flat");
  command->add_option("--tire", options->tire, "Name under assets/tires, or a path: its diameter, pressure exponent");
  add_number(*command, "--tire-diameter", from.tire_diameter_m, meters, "Outer diameter of the tire in m");
  add_number(*command, "--to-tire-diameter", to.tire_diameter_m, meters,
             "Outer diameter of the tire to convert to in m");
  add_number(*command, "--from-pressure", from.pressure_Pa, gauge, "Gauge pressure in kPa");
  add_number(*command, "--to-pressure", to.pressure_Pa, gauge, "Gauge pressure to convert to in kPa");
  add_number(*command, "--from-ambient", from.ambient_K, air, "Temperature of the air in degC");
  add_number(*command, "--to-ambient", to.ambient_K, air, "Temperature of the air to convert to in degC");
  CLI::Option* exponent = add_number(*command, "--pressure-exponent", options->exponents.pressure,
                                     {between(-1.0, 3.0), "-"}, "a of (p/p_ref)^-a [the tire's, else 0.4]");
  add_number(*command, "--load-exponent", options->exponents.load, {between(0.0, 3.0), "-"},
             "Exponent of the force over load [1]");
  command->add_option("--json", options->json, "File for the result, - for standard output");
  command->callback([options, exponent, &action] {
    const bool exponent_given = exponent->count() > 0;
    action = [options, exponent_given] { return convert_command(*options, exponent_given); };
  });
}

}  // namespace rollrig::cli
