// Coefficients of rolling resistance for other programs: each file, evaluated as its program does, gives the force of
// the law.
#include "exports/coefficients.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "estimation/rolling_law/rolling_output.h"
#include "scenarios/common/speed_trace.h"
#include "sim/core/error.h"
#include "tables/tir_file.h"
#include "tests/support/run_program.h"

using namespace rollrig;

namespace {

const estimation::J2452Law kLaw{-0.42, 0.93, 0.055, 9.0e-5, 3.5e-7};
constexpr double kLoad_N = 4200.0;
constexpr double kPressure_Pa = 260e3;

/// A fit's document as the program writes it, and the coefficients read back from it.
exports::RollingCoefficients make_coefficients(bool with_reference = true,
                                               const std::vector<std::string>& warnings = {}) {
  estimation::RollingTest test;
  test.tire = "a50";
  for (const double load_N : {2000.0, 6000.0}) {
    for (const double pressure_Pa : {200e3, 300e3}) {
      for (const double km_h : {15.0, 65.0, 115.0}) {
        test.points.push_back({km_h / 3.6, load_N, pressure_Pa, kLaw.calc_force_N(pressure_Pa, load_N, km_h / 3.6)});
      }
    }
  }
  const estimation::J2452Fit fit = estimation::fit_j2452(test.points);
  const auto moments = [](const char* name) {
    const scenarios::SpeedTrace cycle = scenarios::read_speed_trace(name);
    return estimation::calc_speed_moments(cycle.time_s, cycle.speed_m_s);
  };
  std::optional<estimation::J2452Reference> reference;
  if (with_reference) {
    reference = estimation::evaluate_reference(fit, estimation::make_standard_reference(6000.0, 240e3),
                                               {"udds", "hwfet", moments("udds"), moments("hwfet")});
  }
  const tests::TemporaryFolder folder;
  test.warnings = warnings;
  tests::write_file(folder.file("fit.json"), to_text(estimation::make_j2452_json(test, fit, reference)));
  return exports::read_rolling_coefficients(folder.path());
}

/// The number behind a key, whatever stands between.
double find_value(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\n" + key);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(text.find_first_of("-0123456789", at + 1 + key.size())));
}

}  // namespace

TEST_CASE("a fit's document gives its law back", "[fast]") {
  const exports::RollingCoefficients read = make_coefficients();
  CHECK(read.tire == "a50");
  CHECK(read.points.size() == 12);
  CHECK(read.low_m_s == Approx(15.0 / 3.6));
  REQUIRE(read.reference.has_value());
  CHECK(read.reference->load_N == Approx(kLoad_N));
  CHECK(read.reference->pressure_Pa == Approx(kPressure_Pa));
  CHECK(read.law.calc_force_N(230e3, 3000.0, 20.0) == Approx(kLaw.calc_force_N(230e3, 3000.0, 20.0)).epsilon(1e-6));
}

TEST_CASE("coefficients of a fit with warnings say so", "[fast]") {
  CHECK(make_coefficients().warnings.empty());
  CHECK_THAT(exports::make_simscape(make_coefficients()), !Catch::Contains("warning"));
  const exports::RollingCoefficients doubted = make_coefficients(true, {"the force may be in lbf"});
  CHECK(doubted.warnings == std::vector<std::string>{"the force may be in lbf"});
  CHECK_THAT(exports::make_simscape(doubted), Catch::Contains("% The fit has 1 warning, in its fit.json"));
  CHECK_THAT(exports::make_tir(doubted, 0.32), Catch::Contains("! : The fit has 1 warning"));
}

TEST_CASE("the .tir file, read by the reader of .tir files, has the force of the law", "[fast]") {
  const exports::RollingCoefficients coefficients = make_coefficients();
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("tire.tir"), exports::make_tir(coefficients, 0.3588));
  const tables::TirFile tir = tables::read_tir(folder.file("tire.tir"));
  CHECK(tir.warnings.empty());
  CHECK(tir.version == 62);
  const double v0_m_s = 80.0 / 3.6;
  const auto ratio = [&](double load_N, double pressure_Pa, double speed_m_s) {
    return tables::calc_rolling_resistance_N(tir, load_N, pressure_Pa, speed_m_s) /
           kLaw.calc_force_N(pressure_Pa, load_N, speed_m_s);
  };
  // At the reference speed it is exact at every load and pressure, to the digits of the file.
  for (const double load_N : {2000.0, kLoad_N, 6000.0}) {
    for (const double pressure_Pa : {200e3, kPressure_Pa, 300e3}) {
      CHECK(ratio(load_N, pressure_Pa, v0_m_s) == Approx(1.0).epsilon(1e-6));
    }
  }
  // Elsewhere it stays within the deviation that it states, and that is small.
  const double deviation = exports::fit_magic_formula(coefficients).deviation;
  CHECK(deviation < 0.02);
  for (const double km_h : {15.0, 40.0, 65.0, 100.0, 115.0}) {
    CHECK(std::abs(ratio(5000.0, 240e3, km_h / 3.6) - 1.0) <= deviation * 1.01);
  }
}

TEST_CASE("the Simscape parameters give the force in Pa, N and m/s", "[fast]") {
  const std::string text = exports::make_simscape(make_coefficients());
  const double alpha = find_value(text, "rolling.alpha");
  const double beta = find_value(text, "rolling.beta");
  const double A = find_value(text, "rolling.A"), B = find_value(text, "rolling.B"), C = find_value(text, "rolling.C");
  for (const double v : {5.0, 20.0, 31.0}) {
    // the block's equation with P0 = 1 Pa, N0 = 1 N
    const double block_N = std::pow(210e3 / 1.0, alpha) * std::pow(3700.0 / 1.0, beta) * (A + B * v + C * v * v);
    CHECK(block_N == Approx(kLaw.calc_force_N(210e3, 3700.0, v)).epsilon(1e-6));
  }
  CHECK(find_value(text, "rolling.tire_pressure") == Approx(kPressure_Pa));
  CHECK(find_value(text, "rolling.constant_coefficient") ==
        Approx(kLaw.calc_force_N(kPressure_Pa, kLoad_N, 80.0 / 3.6) / kLoad_N).epsilon(1e-6));
}

TEST_CASE("FASTSim and CO2MPAS get the mean coefficient, and CO2MPAS the share of four tires", "[fast]") {
  const exports::RollingCoefficients coefficients = make_coefficients();
  double mean_N = 0.0;
  for (const auto& [name, share] : {std::pair("udds", 0.55), std::pair("hwfet", 0.45)}) {
    const scenarios::SpeedTrace cycle = scenarios::read_speed_trace(name);
    double work_J = 0.0, distance_m = 0.0;
    for (std::size_t i = 1; i < cycle.time_s.size(); ++i) {  // by means of steps of 1 s
      const double v = 0.5 * (cycle.speed_m_s[i] + cycle.speed_m_s[i - 1]);
      work_J += kLaw.calc_force_N(kPressure_Pa, kLoad_N, v) * v;
      distance_m += v;
    }
    mean_N += share * work_J / distance_m;
  }
  const double fastsim = find_value("\n" + exports::make_fastsim(coefficients), "  wheel_rr_coef");
  CHECK(fastsim == Approx(mean_N / kLoad_N).epsilon(1e-4));  // 1 s is a coarse step where the speed changes
  const std::string co2mpas = exports::make_co2mpas(coefficients, 4);
  CHECK(find_value(co2mpas, "rolling_resistance_coeff") == Approx(fastsim).epsilon(1e-8));
  const double km_h = 70.0;
  const double road_load_N =
      find_value(co2mpas, "f0:") + find_value(co2mpas, "f1:") * km_h + find_value(co2mpas, "f2:") * km_h * km_h;
  CHECK(road_load_N == Approx(4.0 * kLaw.calc_force_N(kPressure_Pa, kLoad_N, km_h / 3.6)).epsilon(1e-6));
}

TEST_CASE("the TYDEX file has every point, in the units that it states", "[fast]") {
  const exports::RollingCoefficients coefficients = make_coefficients();
  std::istringstream lines(exports::make_tydex(coefficients));
  std::vector<std::string> channels;
  std::vector<std::vector<double>> rows;
  std::string part;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("**", 0) == 0) {
      part = line;
      continue;
    }
    if (line.rfind("!", 0) == 0) continue;
    std::istringstream words(line);
    if (part == "**MEASURCHANNELS") {
      channels.emplace_back();
      words >> channels.back();
    } else if (part == "**MEASURDATA") {
      rows.emplace_back();
      for (double value = 0.0; words >> value;) rows.back().push_back(value);
    }
  }
  CHECK(part == "**END");
  REQUIRE(channels == std::vector<std::string>{"MEASNUMB", "LONGVEL", "FZW", "INFLPRES", "FX"});
  REQUIRE(rows.size() == coefficients.points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == 5);
    CHECK(rows[i][0] == static_cast<double>(i + 1));
    CHECK(-rows[i][4] == Approx(kLaw.calc_force_N(rows[i][3], rows[i][2], rows[i][1])).epsilon(1e-4));
  }
}

TEST_CASE("what a target needs and the fit does not say is asked for", "[fast]") {
  const exports::RollingCoefficients bare = make_coefficients(false);
  CHECK_THROWS_WITH(exports::make_fastsim(bare), Catch::Contains("no reference condition"));
  CHECK_THROWS_WITH(exports::make_tir(bare, 0.35), Catch::Contains("no reference condition"));
  CHECK_THROWS_WITH(exports::make_tir(make_coefficients(), std::nullopt), Catch::Contains("unloaded radius"));
  CHECK_NOTHROW(exports::make_tydex(bare));
}

TEST_CASE("a name of another file cannot add lines to what is written", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("fit.json"),
                    "{\"format\": \"rollrig-j2452-fit/1\", \"tire\": \"a\\nQSY1 = 9\", \"coefficients\": {\"alpha\": "
                    "{\"value\": -0.4}, \"beta\": {\"value\": 0.9}, \"a\": {\"value\": 0.1}, \"b\": {\"value\": 1e-4}, "
                    "\"c\": {\"value\": 1e-6}}, \"points\": [{\"speed_km_h\": 80, \"load_N\": 4000, \"pressure_kPa\": "
                    "240, \"rolling_resistance_N\": 36}]}");
  CHECK_THAT(exports::make_tydex(exports::read_rolling_coefficients(folder.path())),
             Catch::Contains("tire a\\nQSY1 = 9\n"));
}
