#pragma once
/// What the sidewall of a tire says of it.

#include <optional>
#include <string>

namespace rollrig::scenarios {

/// A size such as 205/55 R16.
struct TireSize {
  std::string designation;  // "205/55 R16"
  double section_width_m = 0.0;
  double outer_diameter_m = 0.0;
  double rim_diameter_m = 0.0;
  bool is_commercial = false;  // marked C or LT
  std::string load_index;      // where one follows the size; else empty
  std::string speed_symbol;    // likewise, in capitals
};

/// Equation  D = d + 2 h W
/// Symbols   D outer diameter, d rim diameter in inches of 25.4 mm, W section width, h aspect ratio
/// Source    UN Regulation No. 30, 6.1.2
/// Errors    InputError: a text that is no metric size
TireSize parse_tire_size(const std::string& text);

/// Load that a tire of this index may carry. Of "156/150", single and dual mounting, the first counts.
/// Errors    InputError: no number from 60 to 179
/// Source    UN Regulation No. 54, Annex 4
double find_load_capacity_N(const std::string& load_index);

/// What the sidewall has behind the size.
struct ServiceMark {
  int load_index = 0;
  std::string speed_symbol;  // empty where it is not there
};

/// Load index, with or without speed symbol: "91", "91V", "156/150 L".
/// Errors   InputError: no load index, or a letter behind it that is no speed symbol
/// Checked  tests/scenarios/scaffold_test.cpp, tests/api/label_test.cpp
ServiceMark parse_service_mark(const std::string& text);

/// The speed symbol that is given by itself, else that of the mark. Throws InputError where both are there and differ,
/// or where it is not a speed symbol.
std::string choose_speed_symbol(const std::string& given, const ServiceMark& mark);

/// Class of UN Regulation No. 117, paragraph 2.4: "C1", "C2" or "C3". Assumed: a size without the mark C or LT is of C1
/// up to index 121; the regulation also asks for the speed symbol.
std::string find_tire_class(const TireSize& size, int load_index);

}  // namespace rollrig::scenarios
