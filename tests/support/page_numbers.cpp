#include "tests/support/page_numbers.h"

#include <catch2/catch.hpp>
#include <regex>
#include <vector>

namespace rollrig::tests {

void check_page(const std::string& written, const std::string& now) {
  static const std::regex number(R"([-+]?[0-9]+(\.[0-9]+)?)");
  const std::string blank = "#";
  CHECK(std::regex_replace(written, number, blank) == std::regex_replace(now, number, blank));
  const auto numbers = [](const std::string& text) {
    std::vector<double> values;
    for (std::sregex_iterator it(text.begin(), text.end(), number); it != std::sregex_iterator(); ++it) {
      values.push_back(std::stod(it->str()));
    }
    return values;
  };
  const std::vector<double> old_values = numbers(written);
  const std::vector<double> values = numbers(now);
  REQUIRE(old_values.size() == values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    CHECK(values[i] == Approx(old_values[i]).epsilon(2e-3).margin(0.02));
  }
}

}  // namespace rollrig::tests
