#include "tables/tir_file.h"

#include <fmt/format.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::tables {
namespace {

struct Entry {
  std::string value;
  int line = 0;
};

/// The entries KEY = VALUE of all sections. Keys of one name in two sections are the same, as far as they are read
/// here.
class Entries {
 public:
  explicit Entries(const std::string& path) : path_(path) {
    std::istringstream lines(read_text_file(path));
    int number = 1;
    for (std::string line; std::getline(lines, line); ++number) {
      line.erase(std::min(line.find_first_of("$!"), line.size()));
      const std::size_t equals = line.find('=');
      if (equals == std::string::npos) continue;
      std::string value = boost::algorithm::trim_copy(line.substr(equals + 1));
      boost::algorithm::trim_if(value, [](char c) { return c == '\'' || c == '"'; });
      if (value.empty()) continue;
      entries_[boost::algorithm::to_upper_copy(boost::algorithm::trim_copy(line.substr(0, equals)))] = {value, number};
    }
  }

  std::optional<double> find_number(const std::string& key) const {
    const auto entry = entries_.find(key);
    if (entry == entries_.end()) return std::nullopt;
    const std::optional<double> number = parse_number(entry->second.value);
    if (number.has_value()) return number;
    throw InputError({fmt::format("'{}' is not a number", entry->second.value), path_, entry->second.line, key,
                      entry->second.value, "a number", ""});
  }

  double get_positive(const std::string& key) const {
    const std::optional<double> number = find_number(key);
    if (number.has_value() && *number > 0.0) return *number;
    const auto entry = entries_.find(key);
    throw InputError({number.has_value() ? key + " is not positive" : "missing key " + key, path_,
                      number.has_value() ? entry->second.line : 0, key, number.has_value() ? entry->second.value : "",
                      "a positive number", ""});
  }

  /// FITTYP, the version of the tire model; 0 where the file has none.
  int get_version() const {
    constexpr double kHighest = 1000.0;  // Assumed: that of Pacejka's model of 2012 is 62
    const double version = find_number("FITTYP").value_or(0.0);
    if (version >= 0.0 && version <= kHighest && version == std::floor(version)) return static_cast<int>(version);
    const Entry& entry = entries_.at("FITTYP");
    throw InputError({"FITTYP is no version", path_, entry.line, "FITTYP", entry.value,
                      fmt::format("a whole number, 0 to {:.0f}", kHighest), ""});
  }

  void require_unit(const std::string& key, const std::string& unit) const {
    const auto entry = entries_.find(key);
    if (entry == entries_.end() || boost::algorithm::to_lower_copy(entry->second.value) == unit) return;
    throw InputError({fmt::format("a unit of {} that is not read", key), path_, entry->second.line, key,
                      entry->second.value, "'" + unit + "'", ""});
  }

 private:
  std::string path_;
  std::map<std::string, Entry> entries_;
};

void add_warnings(TirFile& tir) {
  const double rrc =
      calc_rolling_resistance_N(tir, tir.load_N, tir.pressure_Pa.value_or(1.0), tir.speed_m_s) / tir.load_N;
  constexpr double kLeast = 0.002;  // Assumed: of a tire of a car or truck
  constexpr double kMost = 0.05;
  if (rrc == 0.0) {
    tir.warnings.push_back("the coefficients of rolling resistance are 0: the file was made without it");
  } else if (rrc < kLeast || rrc > kMost) {
    tir.warnings.push_back(fmt::format("RRc of {:.4g} N/kN at nominal load is that of no tire", 1e3 * rrc));
  }
  if (tir.has_exponents() && !tir.pressure_Pa.has_value() && tir.coefficients[7] != 0.0) {
    tir.warnings.push_back("QSY8 is not used: the file has no NOMPRES");
  }
  if (!tir.has_exponents() && (tir.coefficients[6] != 0.0 || tir.coefficients[7] != 0.0)) {
    tir.warnings.push_back(fmt::format("QSY7 and QSY8 are not used: they came with FITTYP 61, and the file has {}",
                                       tir.version == 0 ? "none" : std::to_string(tir.version)));
  }
}

}  // namespace

TirFile read_tir(const std::string& path) {
  const Entries entries(path);
  entries.require_unit("LENGTH", "meter");
  entries.require_unit("FORCE", "newton");
  entries.require_unit("TIME", "second");
  TirFile tir;
  tir.path = path;
  tir.version = entries.get_version();
  tir.radius_m = entries.get_positive("UNLOADED_RADIUS");
  tir.load_N = entries.get_positive("FNOMIN");
  tir.speed_m_s = entries.get_positive("LONGVL");
  tir.pressure_Pa = entries.find_number("NOMPRES");
  tir.stiffness_N_per_m = entries.find_number("VERTICAL_STIFFNESS");
  tir.scale = entries.find_number("LMY").value_or(1.0);
  if (!entries.find_number("QSY1").has_value()) {
    throw InputError(
        {"the file has no rolling resistance", path, 0, "QSY1", "", "[ROLLING_COEFFICIENTS] with QSY1", ""});
  }
  for (std::size_t i = 0; i < tir.coefficients.size(); ++i) {
    tir.coefficients[i] = entries.find_number(fmt::format("QSY{}", i + 1)).value_or(0.0);
  }
  add_warnings(tir);
  return tir;
}

double calc_rolling_resistance_N(const TirFile& tir, double load_N, double pressure_Pa, double speed_m_s) {
  const std::array<double, 8>& q = tir.coefficients;
  const double speed = std::abs(speed_m_s) / tir.speed_m_s;
  const double at_nominal = tir.scale * (q[0] + q[2] * speed + q[3] * std::pow(speed, 4.0));
  const bool is_stiff = tir.stiffness_N_per_m.has_value() && *tir.stiffness_N_per_m * tir.radius_m > 2.0 * load_N;
  const double loaded_m = is_stiff ? tir.radius_m - load_N / *tir.stiffness_N_per_m : tir.radius_m;
  const double lever = tir.radius_m / loaded_m;
  if (!tir.has_exponents()) return lever * load_N * at_nominal;
  const double pressure = tir.pressure_Pa.has_value() ? std::pow(pressure_Pa / *tir.pressure_Pa, q[7]) : 1.0;
  return lever * tir.load_N * at_nominal * std::pow(load_N / tir.load_N, q[6]) * pressure;
}

}  // namespace rollrig::tables
