#include "rollrig/vecto.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cctype>
#include <cmath>
#include <optional>

#include "api/declared_rrc.h"
#include "exports/vecto_tire.h"
#include "models/tire/label_class.h"
#include "models/tire/tire_file.h"
#include "scenarios/scaffold/iso_test.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"

namespace rollrig {
namespace {

/// An id that XML allows.
std::string make_vecto_id(const std::string& name) {
  std::string id = "TYR-";
  for (const char c : name) id += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : '-';
  return id;
}

/// The RRc to declare: the given one, else that of the simulated test, whose warnings are added.
double find_declared_rrc(const VectoTireInput& input, const models::TireFile& tire,
                         std::vector<std::string>& warnings) {
  if (input.rrc_N_per_kN.has_value()) {
    warnings = tire.list_class_doubts();
    const double rrc = models::round_declared_rrc(read_declared_rrc(*input.rrc_N_per_kN));
    if (tire.service.has_value()) {
      const auto doubt = models::doubt_class_by_rrc(tire.service->tire_class, rrc, tire.service->is_severe_snow);
      if (doubt.has_value()) warnings.push_back(*doubt);
    }
    return rrc;
  }
  const scenarios::StatedIsoTest test = scenarios::simulate_stated_iso_test(tire);
  warnings = test.warnings;
  return models::round_declared_rrc(test.rrc);
}

std::string without_spaces(const std::string& text) { return boost::algorithm::erase_all_copy(text, " "); }

/// The size as VECTO writes it; spaces do not count.
std::string find_vecto_dimension(const VectoTireInput& input, const models::TireFile& tire) {
  const std::string dimension = input.dimension.value_or(tire.designation);
  const std::vector<std::string>& known = exports::list_vecto_dimensions();
  const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& size) {
    return without_spaces(size) == without_spaces(dimension);
  });
  if (found != known.end()) return *found;
  throw InputError({fmt::format("VECTO has no tire size '{}'", dimension), "command line", 0, "--dimension", dimension,
                    "a size of Regulation (EU) 2017/2400, Annex I, for trucks, buses and vans, such as 315/80 R22.5",
                    nearest_name(dimension, known)});
}

/// A question where the size is not that of the tire, whose designation may go on with load index and speed symbol.
std::optional<std::string> doubt_dimension(const std::string& dimension, const models::TireFile& tire) {
  const std::string own = without_spaces(tire.designation);
  if (own.empty() || own.rfind(without_spaces(dimension), 0) == 0) return std::nullopt;
  return fmt::format("--dimension {} is not the size of tire '{}', which is {}: is it the right tire?", dimension,
                     tire.name, tire.designation);
}

/// Throws InputError where a date does not look as the schema has it; whether there is such a day, the schema says.
void require_vecto_date(const std::string& date) {
  constexpr const char* kFirst = "2017-01-01T00:00:00Z";
  const std::string pattern = "dddd-dd-ddTdd:dd:ddZ";
  const bool looks_right = std::equal(date.begin(), date.end(), pattern.begin(), pattern.end(),
                                      [](char c, char p) { return p == 'd' ? '0' <= c && c <= '9' : c == p; });
  if (looks_right && date >= kFirst) return;
  throw InputError({fmt::format("'{}' is not a date and time in UTC from 2017 on", date), "command line", 0, "--date",
                    date, fmt::format("a time such as {}, or a later one", kFirst), ""});
}

/// The text that is given; throws InputError where it has no character that shows.
std::string take_or(const std::optional<std::string>& given, const std::string& option, const std::string& fallback) {
  if (!given.has_value()) return fallback;
  if (!boost::algorithm::trim_copy(*given).empty()) return *given;
  throw InputError({fmt::format("{} is empty", option), "command line", 0, option, *given,
                    fmt::format("a text, or no {} for '{}'", option, fallback), ""});
}

}  // namespace

VectoTireFile make_vecto_tire(const VectoTireInput& input) {
  const models::TireFile tire = models::read_tire(read_config(find_asset("tires", input.tire)));
  if (!tire.iso_28580.has_value()) {
    throw InputError({fmt::format("tire '{}' has no table [iso_28580], which says the load of the test", tire.name),
                      tire.path, 0, "", "", "a table [iso_28580]", ""});
  }
  exports::VectoTire component;
  component.id = make_vecto_id(tire.name);
  component.manufacturer = take_or(input.manufacturer, "--manufacturer", "simulated");
  component.model = take_or(input.model, "--model", tire.name);
  component.certification_number =
      take_or(input.certification_number, "--certification-number", "simulated, not certified");
  component.date = take_or(input.date, "--date", "2017-01-01T00:00:00Z");
  require_vecto_date(component.date);
  component.app_version = fmt::format("rollrig {}", ROLLRIG_VERSION);
  component.dimension = find_vecto_dimension(input, tire);
  VectoTireFile made;
  component.rrc = find_declared_rrc(input, tire, made.warnings);
  component.load_N = static_cast<int>(std::lround(tire.iso_28580->load_N));
  made.xml = exports::make_vecto_xml(component);
  made.rrc = component.rrc;
  made.load_N = component.load_N;
  if (const auto doubt = doubt_dimension(component.dimension, tire)) made.warnings.push_back(*doubt);
  return made;
}

}  // namespace rollrig
