#include "sim/core/units.h"

#include <algorithm>
#include <array>
#include <vector>

#include <boost/algorithm/string/join.hpp>

namespace rollrig {
namespace {

struct UnitToken {
  const char* token;
  const char* symbol;
  Dimension dimension;
  double factor;
};

constexpr double kHour_s = 3600.0;

/// Every unit that may stand in a suffix. A power is written into the token, as in "m2".
constexpr std::array<UnitToken, 34> kTokens{{
    {"N", "N", dimension::kForce, 1.0},
    {"kN", "kN", dimension::kForce, 1e3},
    {"Nm", "N m", {1, 2, -2, 0}, 1.0},
    {"m", "m", dimension::kLength, 1.0},
    {"mm", "mm", dimension::kLength, 1e-3},
    {"km", "km", dimension::kLength, 1e3},
    {"mi", "mi", dimension::kLength, kMile_m},
    {"m2", "m2", {0, 2, 0, 0}, 1.0},
    {"m3", "m3", {0, 3, 0, 0}, 1.0},
    {"s", "s", dimension::kTime, 1.0},
    {"s2", "s2", {0, 0, 2, 0}, 1.0},
    {"min", "min", dimension::kTime, 60.0},
    {"h", "h", dimension::kTime, kHour_s},
    {"h2", "h2", {0, 0, 2, 0}, kHour_s* kHour_s},
    {"kg", "kg", dimension::kMass, 1.0},
    {"J", "J", {1, 2, -2, 0}, 1.0},
    {"kJ", "kJ", {1, 2, -2, 0}, 1e3},
    {"Wh", "Wh", {1, 2, -2, 0}, kHour_s},
    {"kWh", "kWh", {1, 2, -2, 0}, 1e3 * kHour_s},
    {"W", "W", dimension::kPower, 1.0},
    {"kW", "kW", dimension::kPower, 1e3},
    {"K", "K", dimension::kTemperature, 1.0},
    {"dK", "K", dimension::kTemperature, 1.0},
    {"degC", "degC", dimension::kTemperature, 1.0},
    {"Pa", "Pa", dimension::kPressure, 1.0},
    {"kPa", "kPa", dimension::kPressure, 1e3},
    {"mbar", "mbar", dimension::kPressure, 1e2},
    {"bar", "bar", dimension::kPressure, 1e5},
    {"rad", "rad", dimension::kNone, 1.0},
    {"mrad", "mrad", dimension::kNone, 1e-3},
    {"deg", "deg", dimension::kNone, 0.017453292519943295},
    {"Hz", "Hz", {0, 0, -1, 0}, 1.0},
    {"percent", "%", dimension::kNone, 1e-2},
    {"ms", "ms", dimension::kTime, 1e-3},
}};

const UnitToken* find_token(std::string_view word) {
  for (const UnitToken& token : kTokens) {
    if (word == token.token) return &token;
  }
  return nullptr;
}

/// "m" "s" and their like, written one after the other, mean a quotient: m/s, km/h, rad/s, m/s2.
bool is_quotient(std::string_view first, std::string_view second) {
  return (first == "m" && (second == "s" || second == "s2")) || (first == "km" && second == "h") ||
         (first == "rad" && second == "s");
}

/// "km" "h2" is the square of a speed, as in C_N_per_km_h2.
bool is_speed_squared(std::string_view first, std::string_view second) { return first == "km" && second == "h2"; }

struct Product {
  std::string symbol;
  Dimension dimension;
  double factor = 1.0;
};

Product multiply_tokens(const std::vector<std::string_view>& words) {
  Product product;
  std::vector<std::string> symbols;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const UnitToken& token = *find_token(words[i]);
    std::string symbol = token.symbol;
    product.dimension = product.dimension * token.dimension;
    product.factor *= token.factor;
    if (i + 1 < words.size() && is_quotient(words[i], words[i + 1])) {
      const UnitToken& below = *find_token(words[++i]);
      symbol += std::string("/") + below.symbol;
      product.dimension = product.dimension / below.dimension;
      product.factor /= below.factor;
    } else if (i + 1 < words.size() && is_speed_squared(words[i], words[i + 1])) {
      const UnitToken& below = *find_token(words[++i]);
      symbol = "(km/h)2";
      product.dimension = product.dimension * token.dimension / below.dimension;
      product.factor *= token.factor / below.factor;
    }
    symbols.push_back(symbol);
  }
  product.symbol = boost::algorithm::join(symbols, " ");
  return product;
}

/// Words of a key, parts of its text.
std::vector<std::string_view> split_words(std::string_view key) {
  std::vector<std::string_view> words;
  for (std::size_t end = key.find('_'); end != std::string_view::npos; end = key.find('_')) {
    words.push_back(key.substr(0, end));
    key.remove_prefix(end + 1);
  }
  words.push_back(key);
  return words;
}

/// Index of the first word of the unit suffix; words.size() when there is none. A unit has one "per" at most, and does
/// not end with it.
std::size_t find_suffix_start(const std::vector<std::string_view>& words) {
  std::size_t start = words.size();
  for (bool is_below = true; start > 1; --start) {
    const bool is_per = words[start - 1] == "per";
    if (is_per ? !is_below || start == words.size() : find_token(words[start - 1]) == nullptr) break;
    if (is_per) is_below = false;
  }
  return start;
}

std::string_view without_sd(std::string_view key) {
  constexpr std::string_view kSd = "_sd";
  if (key.size() > kSd.size() && key.substr(key.size() - kSd.size()) == kSd) key.remove_suffix(kSd.size());
  return key;
}

}  // namespace

Unit unit_of_key(std::string_view key) {
  const std::string_view base = without_sd(key);
  const std::vector<std::string_view> words = split_words(base);
  std::size_t per = words.size();
  const std::size_t start = find_suffix_start(words);
  for (std::size_t i = start; i < words.size(); ++i) {
    if (words[i] == "per") per = i;
  }
  using Difference = std::vector<std::string_view>::difference_type;
  const auto at = [&words](std::size_t i) { return words.begin() + static_cast<Difference>(i); };
  const Product above = multiply_tokens({at(start), at(per)});
  Unit unit{above.symbol, above.dimension, above.factor, 0.0};
  if (per < words.size()) {
    const Product below = multiply_tokens({at(per + 1), words.end()});
    const bool compound = below.symbol.find_first_of(" /") != std::string::npos && below.symbol.front() != '(';
    unit.symbol =
        (above.symbol.empty() ? "1" : above.symbol) + "/" + (compound ? "(" + below.symbol + ")" : below.symbol);
    unit.dimension = above.dimension / below.dimension;
    unit.factor = above.factor / below.factor;
  }
  const bool is_temperature = unit.symbol == "degC" && base.size() == key.size();
  if (is_temperature) unit.offset_SI = kZeroCelsius_K;
  return unit;
}

std::string name_without_unit(std::string_view key) {
  const std::string_view base = without_sd(key);
  const std::vector<std::string_view> words = split_words(base);
  const std::size_t start = find_suffix_start(words);
  if (start == words.size()) return std::string(base);
  return std::string(base.substr(0, static_cast<std::size_t>(words[start].data() - base.data()) - 1));
}

std::string plain_name(std::string_view key) {
  std::string name = name_without_unit(key);
  std::replace(name.begin(), name.end(), '_', ' ');
  const std::size_t last = name.rfind('.');
  if (last != std::string::npos) name.insert(last + 1, " ")[last] = ':';
  std::replace(name.begin(), name.end(), '.', ' ');
  return name;
}

}  // namespace rollrig
