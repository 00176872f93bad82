// Options by which a user says what logs do not tell: of import --guess, new set and new tire --warm-up.
#include <map>

#include "cli/command.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

/// Splits "key=value" at the first "=". Throws InputError.
std::pair<std::string, std::string> split_assignment(const std::string& option, const std::string& text,
                                                     const char* form) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw usage_error("'" + text + "' is not understood", option, text, form);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void add_texts(CLI::App& command, const std::string& option, std::map<std::string, std::string>& texts,
               const char* form, const char* doc) {
  const auto put = [&texts, option, form](const std::vector<std::string>& all) {
    for (const std::string& one : all)
      texts.insert_or_assign(split_assignment(option, one, form).first, split_assignment(option, one, form).second);
  };
  command.add_option_function<std::vector<std::string>>(option, put, doc)->expected(1)->take_all()->type_name(form);
}

void add_numbers(CLI::App& command, const std::string& option, std::map<std::string, double>& numbers, const char* form,
                 const char* doc) {
  const auto put = [&numbers, option, form](const std::vector<std::string>& all) {
    for (const std::string& one : all) {
      const auto [key, value] = split_assignment(option, one, form);
      const std::optional<double> number = parse_number(value);
      if (!number.has_value()) throw usage_error("'" + value + "' is not a number", option, one, form);
      numbers[key] = *number;
    }
  };
  command.add_option_function<std::vector<std::string>>(option, put, doc)->expected(1)->take_all()->type_name(form);
}

}  // namespace

void add_guess_options(CLI::App& command, GuessOptions& options) {
  command.add_option("--rig", options.rig, "Name under assets/rigs, or a path");
  command.add_option("--sensors", options.sensors, "Name under assets/sensors, or a path [source, or by the kind]");
  add_texts(command, "--column", options.columns, "COLUMN=HEADING",
            "Heading of the log for a column of the set, or for time");
  add_texts(command, "--unit", options.units, "COLUMN=UNIT", "Unit of the log for a column of the set, or for time");
  add_numbers(command, "--value", options.values, "COLUMN=NUMBER", "Constant for a column of the set");
  command.add_option("--date-order", options.date_order, "Order of day, month and year in dates")
      ->check(CLI::IsMember({"ymd", "dmy", "mdy"}));
  command.add_option("--cold-pressure", options.cold_pressure_kPa, "Gauge pressure of the cold tire in kPa");
  add_numbers(command, "--rest", options.rests_min, "RUN=MINUTES", "Standstill before a run; 0: right after another");
}

void add_guess_set_options(CLI::App& command, GuessOptions& options) {
  command.add_option("--tire", options.tire, "Name under assets/tires, or a path");
  command.add_option("--vehicle", options.vehicle, "Name under assets/vehicles, or a path, of a set of the road");
  command.add_option("--name", options.name, "Name of the set [that of the folder]");
  add_guess_options(command, options);
}

}  // namespace rollrig::cli
