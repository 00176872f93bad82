#include "scenarios/scaffold/tire_size.h"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/text_cursor.h"
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

/// The parts of a size as they are written.
struct WrittenSize {
  std::string width, aspect, rim, load_index;
  bool is_light_truck = false;
};

/// Two or three digits, and two or three more behind a slash where there is one: the load index of twin tires.
std::optional<std::string> take_load_index(TextCursor& cursor) {
  const auto single = cursor.take_digits(2, 3);
  if (!single.has_value() || !cursor.take('/')) return single;
  const auto twin = cursor.take_digits(2, 3);
  if (!twin.has_value()) return std::nullopt;
  return *single + "/" + *twin;
}

/// Width, aspect ratio and rim: "205/55R16", "315/80 ZR 22.5".
bool take_dimensions(TextCursor& cursor, WrittenSize& size) {
  const auto width = cursor.take_digits(3, 3);
  cursor.skip_blanks();
  const bool has_slash = cursor.take('/');
  cursor.skip_blanks();
  const auto aspect = cursor.take_digits(2, 3);
  cursor.skip_blanks();
  cursor.take_one_of("Zz");
  const bool has_build = cursor.take_one_of("RrDd-") != '\0';
  cursor.skip_blanks();
  const auto rim = cursor.take_digits(2, 2);
  if (!width.has_value() || !has_slash || !aspect.has_value() || !has_build || !rim.has_value()) return false;
  size.width = *width;
  size.aspect = *aspect;
  size.rim = *rim;
  if (!cursor.take('.')) return true;
  const auto decimal = cursor.take_digits(1, 1);
  size.rim += "." + decimal.value_or("");
  return decimal.has_value();
}

std::optional<WrittenSize> split_size(const std::string& text) {
  WrittenSize size;
  TextCursor cursor(text);
  cursor.skip_blanks();
  size.is_light_truck = cursor.take_word("LT");
  if (!size.is_light_truck) cursor.take_one_of("Pp");
  cursor.skip_blanks();
  if (!take_dimensions(cursor, size)) return std::nullopt;
  bool is_apart = cursor.skip_blanks() > 0;
  if (cursor.take_one_of("Cc") != '\0' || cursor.take_word("LT")) {
    size.is_light_truck = true;
    is_apart = cursor.skip_blanks() > 0;
  }
  if (cursor.at_end()) return size;
  const auto load_index = take_load_index(cursor);
  if (!is_apart || !load_index.has_value()) return std::nullopt;
  size.load_index = *load_index;
  cursor.skip_blanks();
  cursor.take_letters(1, 1);  // of the speed
  cursor.skip_blanks();
  if (!cursor.at_end()) return std::nullopt;
  return size;
}

}  // namespace

TireSize parse_tire_size(const std::string& text) {
  const auto written = split_size(text);
  if (!written.has_value()) throw bad_size(text, fmt::format("'{}' is no size of a tire", text));
  const double width_mm = std::stod(written->width);
  const double aspect_percent = std::stod(written->aspect);
  const double rim_in = std::stod(written->rim);
  if (width_mm < 100.0 || width_mm > 500.0 || aspect_percent < 20.0 || aspect_percent > 100.0 || rim_in < 8.0 ||
      rim_in > 26.0) {
    throw bad_size(text, fmt::format("'{}' is no size of a tire for the road", text));
  }
  TireSize size;
  size.is_commercial = written->is_light_truck;
  size.designation = fmt::format("{:g}/{:g} R{:g}{}", width_mm, aspect_percent, rim_in, size.is_commercial ? "C" : "");
  size.section_width_m = width_mm * 1e-3;
  size.rim_diameter_m = rim_in * kInch_m;
  size.outer_diameter_m = size.rim_diameter_m + 2.0 * aspect_percent * 0.01 * size.section_width_m;
  size.load_index = written->load_index;
  return size;
}

int parse_load_index(const std::string& load_index) {
  TextCursor cursor(load_index);
  cursor.skip_blanks();
  const auto written = take_load_index(cursor);
  cursor.skip_blanks();
  cursor.take_letters(1, 1);  // of the speed
  cursor.skip_blanks();
  const int index = written.has_value() && cursor.at_end() ? std::stoi(*written) : 0;  // the first of two
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
