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
/// Errors    InputError: those of parse_service_description()
/// Source    UN Regulation No. 54, Annex 4
double find_load_capacity_N(const std::string& load_index);

/// The service description behind the size on a sidewall.
struct ParsedServiceDescription {
  int load_index = 0;        // of single mounting
  int dual_index = 0;        // of dual mounting; 0 if there is none
  std::string speed_symbol;  // empty if there is none
};

/// Load index, with or without speed symbol: "91", "91V", "156/150 L".
/// Errors   InputError: no load index, a letter behind it that is no speed symbol, or an index of dual mounting that is
///          above that of single mounting
/// Checked  tests/scenarios/scaffold_test.cpp, tests/api/label_test.cpp
ParsedServiceDescription parse_service_description(const std::string& text, const char* option = "--load-index");

/// The speed symbol that is given with --speed-symbol, else that of the service description.
/// Errors   InputError: both are there and differ, or the given one is no speed symbol
std::string choose_speed_symbol(const std::string& given, const ParsedServiceDescription& description);

/// Class of UN Regulation No. 117, paragraph 2.4: "C1", "C2" or "C3". Assumed: a size without the mark C or LT is of C1
/// up to index 121; the regulation also asks for the speed symbol.
std::string find_tire_class(const TireSize& size, const ParsedServiceDescription& description);

/// A doubt about class C1 where the size or the load index is that of a van or a truck.
std::optional<std::string> doubt_class_by_size(const std::string& tire_class, bool is_commercial,
                                               const ParsedServiceDescription& description);

}  // namespace rollrig::scenarios
