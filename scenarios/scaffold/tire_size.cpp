#include "scenarios/scaffold/tire_size.h"

#include <optional>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>

#include "models/tire/tire_class.h"
#include "sim/core/error.h"
#include "sim/core/text_cursor.h"
#include "sim/core/units.h"

namespace rollrig::scenarios {
namespace {

constexpr double kInch_m = 0.0254;

InputError bad_size(const std::string& text, const std::string& what) {
  return InputError(
      {what, "command line", 0, "--size", text,
       "a metric size: width in mm, aspect ratio in percent, rim in inches, as in 205/55R16 or 315/80R22.5", ""});
}

/// The parts of a size as they are written.
struct WrittenSize {
  std::string width, aspect, rim, load_index, speed_symbol;
  bool is_light_truck = false;
};

/// Two or three digits, and two or three more behind a slash where there is one: the load index of dual mounting.
std::optional<std::string> take_load_index(TextCursor& cursor) {
  const auto single = cursor.take_digits(2, 3);
  if (!single.has_value() || !cursor.take('/')) return single;
  const auto dual = cursor.take_digits(2, 3);
  if (!dual.has_value()) return std::nullopt;
  return *single + "/" + *dual;
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
  size.speed_symbol = boost::algorithm::to_upper_copy(cursor.take_letters(1, 1).value_or(""));
  cursor.skip_blanks();
  if (!cursor.at_end()) return std::nullopt;
  return size;
}

/// Throws InputError where a symbol is there that is none; `text` is what the option has.
void require_speed_symbol(const std::string& symbol, const char* option, const std::string& text) {
  if (symbol.empty() || models::find_symbol_speed_km_h(symbol).has_value()) return;
  throw InputError({fmt::format("'{}' is not a speed symbol", symbol), "command line", 0, option, text,
                    fmt::format("one of {}", fmt::join(models::list_speed_symbols(), " ")), ""});
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
  size.speed_symbol = written->speed_symbol;
  require_speed_symbol(size.speed_symbol, "--size", text);
  return size;
}

ParsedServiceDescription parse_service_description(const std::string& text, const char* option) {
  TextCursor cursor(text);
  cursor.skip_blanks();
  const auto written = take_load_index(cursor);
  cursor.skip_blanks();
  ParsedServiceDescription parsed;
  parsed.speed_symbol = boost::algorithm::to_upper_copy(cursor.take_letters(1, 1).value_or(""));
  cursor.skip_blanks();
  parsed.load_index = written.has_value() && cursor.at_end() ? std::stoi(*written) : 0;  // of single mounting
  if (!models::find_load_of_index_kg(parsed.load_index).has_value()) {
    throw InputError({fmt::format("'{}' is no load index", text), "command line", 0, option, text,
                      fmt::format("a number from {} to {}, as on the sidewall behind the size",
                                  models::kLowestLoadIndex, models::kHighestLoadIndex),
                      ""});
  }
  require_speed_symbol(parsed.speed_symbol, option, text);
  const std::size_t slash = written->find('/');
  if (slash != std::string::npos) parsed.dual_index = std::stoi(written->substr(slash + 1));
  if (parsed.dual_index > parsed.load_index) {
    throw InputError(
        {fmt::format("the load index of dual mounting, {}, is above that of single mounting", parsed.dual_index),
         "command line", 0, option, text, "that of single mounting first, as in 156/150", ""});
  }
  return parsed;
}

std::string choose_speed_symbol(const std::string& given, const ParsedServiceDescription& description) {
  const std::string symbol = boost::algorithm::to_upper_copy(given);
  require_speed_symbol(symbol, "--speed-symbol", given);
  const std::string& described = description.speed_symbol;
  if (symbol.empty()) return described;
  if (described.empty() || described == symbol) return symbol;
  throw InputError({fmt::format("the service description has the speed symbol {}", described), "command line", 0,
                    "--speed-symbol", given, fmt::format("{}, or no --speed-symbol", described), ""});
}

double find_load_capacity_N(const std::string& load_index) {
  return models::find_load_of_index_kg(parse_service_description(load_index).load_index).value_or(0.0) *
         kStandardGravity_m_s2;
}

std::string find_tire_class(const TireSize& size, const ParsedServiceDescription& description) {
  const double slowest_C2_km_h = models::find_symbol_speed_km_h("N").value();  // UN R117, 2.4
  const auto speed_km_h = models::find_symbol_speed_km_h(description.speed_symbol);
  const bool is_slow = speed_km_h.has_value() && *speed_km_h < slowest_C2_km_h;
  if (description.load_index > models::kHighestLightIndex || (size.is_commercial && is_slow)) return "C3";
  return size.is_commercial ? "C2" : "C1";
}

std::optional<std::string> doubt_class_by_size(const std::string& tire_class, bool is_commercial,
                                               const ParsedServiceDescription& description) {
  if (tire_class != "C1" || (!is_commercial && description.dual_index == 0)) return std::nullopt;
  return fmt::format("{} is that of vans and trucks: is the class C2 or C3, and not C1?",
                     is_commercial ? "the size" : "a load index of dual mounting");
}

}  // namespace rollrig::scenarios
