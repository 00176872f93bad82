#include "scenarios/scaffold/tire_size.h"

#include <array>
#include <cmath>
#include <regex>

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::scenarios {
namespace {

constexpr int kLowestIndex = 60;
constexpr int kHighestIndex = 179;
constexpr int kDecade = 80;  // indices over which the load rises tenfold
constexpr double kInch_m = 0.0254;

/// Loads of the indices 60 to 139 in kg. Those of 140 to 219 are ten times as large, and these are rounded down.
constexpr std::array<double, kDecade> kLoads_kg{
    250.0,  257.5,  265.0,  272.5,  280.0,  290.0,  300.0,  307.5,  315.0,  325.0,  335.0,  345.0,  355.0,  365.0,
    375.0,  387.5,  400.0,  412.5,  425.0,  437.5,  450.0,  462.5,  475.0,  487.5,  500.0,  515.0,  530.0,  545.0,
    560.0,  580.0,  600.0,  615.0,  630.0,  650.0,  670.0,  690.0,  710.0,  730.0,  750.0,  775.0,  800.0,  825.0,
    850.0,  875.0,  900.0,  925.0,  950.0,  975.0,  1000.0, 1030.0, 1060.0, 1090.0, 1120.0, 1150.0, 1180.0, 1215.0,
    1250.0, 1285.0, 1320.0, 1360.0, 1400.0, 1450.0, 1500.0, 1550.0, 1600.0, 1650.0, 1700.0, 1750.0, 1800.0, 1850.0,
    1900.0, 1950.0, 2000.0, 2060.0, 2120.0, 2180.0, 2240.0, 2300.0, 2360.0, 2430.0};

InputError bad_size(const std::string& text, const std::string& what) {
  return InputError(
      {what, "command line", 0, "--size", text,
       "a metric size: width in mm, aspect ratio in percent, rim in inches, as in 205/55R16 or 315/80R22.5", ""});
}

}  // namespace

TireSize parse_tire_size(const std::string& text) {
  static const std::regex shape(
      R"(\s*(P|LT)?\s*(\d{3})\s*/\s*(\d{2,3})\s*Z?([RD-])\s*(\d{2}(?:\.\d)?)\s*(C|LT)?(?:\s+(\d{2,3}(?:/\d{2,3})?)\s*[A-Z]?)?\s*)",
      std::regex::icase);
  std::smatch match;
  if (!std::regex_match(text, match, shape)) throw bad_size(text, fmt::format("'{}' is no size of a tire", text));
  const double width_mm = std::stod(match[2]);
  const double aspect_percent = std::stod(match[3]);
  const double rim_in = std::stod(match[5]);
  if (width_mm < 100.0 || width_mm > 500.0 || aspect_percent < 20.0 || aspect_percent > 100.0 || rim_in < 8.0 ||
      rim_in > 26.0) {
    throw bad_size(text, fmt::format("'{}' is no size of a tire for the road", text));
  }
  TireSize size;
  size.is_commercial = match[6].matched || match[1].str() == "LT" || match[1].str() == "lt";
  size.designation = fmt::format("{:g}/{:g} R{:g}{}", width_mm, aspect_percent, rim_in, size.is_commercial ? "C" : "");
  size.section_width_m = width_mm * 1e-3;
  size.rim_diameter_m = rim_in * kInch_m;
  size.outer_diameter_m = size.rim_diameter_m + 2.0 * aspect_percent * 0.01 * size.section_width_m;
  size.load_index = match[7];
  return size;
}

int parse_load_index(const std::string& load_index) {
  static const std::regex shape(R"(\s*(\d{2,3})(/\d{2,3})?\s*[A-Za-z]?\s*)");
  std::smatch match;
  const int index = std::regex_match(load_index, match, shape) ? std::stoi(match[1]) : 0;
  if (index >= kLowestIndex && index <= kHighestIndex) return index;
  throw InputError(
      {fmt::format("'{}' is no load index", load_index), "command line", 0, "--load-index", load_index,
       fmt::format("a number from {} to {}, as on the sidewall behind the size", kLowestIndex, kHighestIndex), ""});
}

double find_load_capacity_N(const std::string& load_index) {
  const int index = parse_load_index(load_index);
  const int place = index - kLowestIndex;
  const double load_kg = place < kDecade ? std::floor(kLoads_kg[static_cast<std::size_t>(place)])
                                         : 10.0 * kLoads_kg[static_cast<std::size_t>(place - kDecade)];
  return load_kg * kStandardGravity_m_s2;
}

std::string find_tire_class(const TireSize& size, int load_index) {
  constexpr int kLightest = 122;  // UN R117: of class C3
  if (load_index >= kLightest) return "C3";
  return size.is_commercial ? "C2" : "C1";
}

}  // namespace rollrig::scenarios
