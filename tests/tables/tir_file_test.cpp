// Rolling resistance from tire property files.
#include "tables/tir_file.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using namespace rollrig::tables;
using rollrig::tests::TemporaryFolder;

namespace {

std::string make_text(const std::string& version, const std::string& more = "") {
  return "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nTIME = 'second'\n[MODEL]\nFITTYP = " + version +
         "   $ version\nLONGVL = 16.7\n[DIMENSION]\nUNLOADED_RADIUS = 0.32\n[VERTICAL]\nFNOMIN = +4.0E+003\n"
         "[SHAPE]\n 1.00  0.00\n! QSY1 = 5\n[OPERATING_CONDITIONS]\nINFLPRES =\nNOMPRES = 220000\n"
         "[ROLLING_COEFFICIENTS]\nQSY1 = 0.008 $Rolling resistance\nQSY3 = 0.001\nQSY4 = 1e-4\nQSY7 = 0.85\n"
         "QSY8 = -0.4\n" +
         more;
}

TirFile read(const std::string& text) {
  const TemporaryFolder folder;
  rollrig::tests::write_file(folder.file("a.tir"), text);
  return read_tir(folder.file("a.tir"));
}

InputProblem find_problem(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.problem();
  }
  FAIL("no InputError");
  return {};
}

}  // namespace

TEST_CASE("the force of version 6.1 grows with load and pressure by its exponents", "[fast]") {
  const TirFile tir = read(make_text("61"));
  CHECK(tir.warnings.empty());
  const auto force_N = [&tir](double load_N, double pressure_Pa) {
    return calc_rolling_resistance_N(tir, load_N, pressure_Pa, 0.0);
  };
  CHECK(force_N(4000.0, 220e3) / 4000.0 == Approx(0.008));  // QSY1 is RRc at nominal load and pressure, at walking pace
  CHECK(std::log(force_N(5000.0, 220e3) / force_N(4000.0, 220e3)) / std::log(5.0 / 4.0) == Approx(0.85));
  CHECK(std::log(force_N(4000.0, 260e3) / force_N(4000.0, 220e3)) / std::log(26.0 / 22.0) == Approx(-0.4));
  CHECK(calc_rolling_resistance_N(tir, 4000.0, 220e3, 30.0) > calc_rolling_resistance_N(tir, 4000.0, 220e3, 16.7));
}

TEST_CASE("before version 6.1 RRc depends on speed alone, and what is not used is said", "[fast]") {
  const TirFile tir = read(make_text("6"));
  REQUIRE(tir.warnings.size() == 1);
  CHECK_THAT(tir.warnings.front(), Catch::Contains("QSY7"));
  for (const double load_N : {2000.0, 6000.0}) {
    CHECK(calc_rolling_resistance_N(tir, load_N, 300e3, 0.0) / load_N == Approx(0.008));
  }
}

TEST_CASE("the force acts at the loaded radius where the file has a stiffness", "[fast]") {
  const TirFile tir = read(make_text("61", "VERTICAL_STIFFNESS = 200000\n"));
  CHECK(calc_rolling_resistance_N(tir, 4000.0, 220e3, 0.0) * (0.32 - 4000.0 / 200000.0) ==
        Approx(0.008 * 4000.0 * 0.32));
}

TEST_CASE("coefficients that are no tire's are warned of", "[fast]") {
  CHECK_THAT(read(make_text("61", "QSY1 = 0.1\n")).warnings.at(0), Catch::Contains("no tire"));
  CHECK_THAT(read(make_text("61", "LMY = 0\n")).warnings.at(0), Catch::Contains("without"));
}

TEST_CASE("what is wrong in a tire property file is named with its line", "[fast]") {
  CHECK(find_problem(make_text("61", "QSY1 = many\n")).line == 24);
  CHECK(find_problem(make_text("61", "FORCE = 'kN'\n")).key == "FORCE");
  // Found by tools/fuzz: beyond what an int holds.
  for (const char* version : {"18446744073709551615", "-1", "61.5", "1e300"}) {
    CHECK(find_problem(make_text(version)).key == "FITTYP");
  }
  CHECK(find_problem(make_text("61", "FNOMIN = -3\n")).key == "FNOMIN");
  CHECK(find_problem("[MODEL]\nLONGVL = 10\nFNOMIN = 3000\n").key == "UNLOADED_RADIUS");
  CHECK(find_problem("LONGVL = 10\nFNOMIN = 3000\nUNLOADED_RADIUS = 0.3\n").key == "QSY1");
}
