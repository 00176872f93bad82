#include <fmt/format.h>

#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/convert.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::cli {
namespace {

struct ConvertOptions {
  ConversionInput input;
  OutputOptions output;
};

/// A number in the unit of `key`.
void add_in_unit(CLI::App& command, const std::string& option, std::optional<double>& number_SI, const char* key,
                 const char* doc) {
  const auto set = [&number_SI, key](const double& value) { number_SI = unit_of_key(key).to_si(value); };
  command.add_option_function<double>(option, set, doc);
}

/// 1/R of a diameter in m, 0 of "flat".
void add_drum(CLI::App& command, const std::string& option, std::optional<double>& curvature_per_m, const char* doc) {
  const auto set = [&curvature_per_m, option](const std::string& text) {
    const std::optional<double> diameter_m = parse_number(text);
    if (text != "flat" && !(diameter_m.has_value() && *diameter_m >= 0.1)) {  // as convert_loss() allows
      throw usage_error(fmt::format("'{}' is not a drum", text), option, text, "a diameter of 0.1 m or more, or flat");
    }
    curvature_per_m = text == "flat" ? 0.0 : 2.0 / *diameter_m;
  };
  command.add_option_function<std::string>(option, set, doc);
}

int convert_command(const ConvertOptions& options) {
  Output output(options.output);
  const ConvertedLoss converted = convert_loss(options.input);
  output.show(converted);
  return kDone;
}

}  // namespace

void add_convert_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ConvertOptions>(
      app, action, "convert",
      "Take a measured loss to another drum, tire diameter, pressure, temperature of the air or load",
      &convert_command);
  ConversionInput& input = options->input;
  LossConditions& from = input.from;
  LossConditions& to = input.to;
  command->add_option("--force", input.loss.force_N, "Measured loss in N");
  command->add_option("--rrc", input.loss.rrc_N_per_kN, "Measured loss in N/kN");
  command->add_option("--load", from.load_N, "Load in N, to give both force and RRc");
  command->add_option("--to-load", to.load_N, "Load to convert to in N; needs --load");
  add_drum(*command, "--from-drum", from.drum_curvature_per_m, "Diameter of the drum in m, or flat");
  add_drum(*command, "--to-drum", to.drum_curvature_per_m, "Diameter of the drum to convert to in m, or flat");
  command->add_option("--tire", input.tire, "Name under assets/tires, or a path: its diameter, pressure exponent");
  command->add_option("--tire-diameter", from.tire_diameter_m, "Outer diameter of the tire in m");
  command->add_option("--to-tire-diameter", to.tire_diameter_m, "Outer diameter of the tire to convert to in m");
  add_in_unit(*command, "--from-pressure", from.pressure_Pa, "pressure_kPa", "Gauge pressure in kPa");
  add_in_unit(*command, "--to-pressure", to.pressure_Pa, "pressure_kPa", "Gauge pressure to convert to in kPa");
  add_in_unit(*command, "--from-ambient", from.ambient_K, "ambient_degC", "Temperature of the air in degC");
  add_in_unit(*command, "--to-ambient", to.ambient_K, "ambient_degC", "Temperature of the air to convert to in degC");
  command->add_option("--pressure-exponent", input.pressure_exponent,
                      "a of (p/p_ref)^-a; needs --to-pressure [the tire's, else 0.4]");
  command->add_option("--load-exponent", input.load_exponent, "Exponent of the force over load; needs --to-load [1]");
  command->add_option("--diameter-exponent", input.diameter_exponent, "n of D^-n; needs --to-tire-diameter [1/3]");
  command->add_option("--ambient-coefficient", input.ambient_coefficient_per_K,
                      "K_t of ISO 28580 in 1/degC, as of the tire's class; needs --to-ambient [0.008, class C1]");
  add_output_option(*command, "--json", options->output.json, "File for the result, - for standard output");
}

}  // namespace rollrig::cli
