// A loss converted by a program of somebody else's, through the shared library.
#include <rollrig/convert.h>
#include <rollrig/error.h>

#include <catch2/catch.hpp>

#include "tests/support/run_program.h"

using rollrig::ConversionInput;
using rollrig::convert_loss;
using rollrig::ConvertedLoss;
using rollrig::tests::run_program;

namespace {

constexpr double kZeroCelsius_K = 273.15;

/// A tire on a drum of 2 m, wanted on the flat road, at other pressure, air and load.
ConversionInput make_conversion() {
  ConversionInput input;
  input.loss.force_N = 32.0;
  input.from = {1.0, 0.7176, 250e3, 25.0 + kZeroCelsius_K, 5400.0};
  input.to = {0.0, 0.65, 280e3, 21.0 + kZeroCelsius_K, 4800.0};
  return input;
}

/// The option that is named where the input is refused.
std::string find_refused(const ConversionInput& input) {
  try {
    convert_loss(input);
  } catch (const rollrig::InputError& error) {
    return error.problem().key;
  }
  return "";
}

}  // namespace

TEST_CASE("a loss is converted as the command converts it", "[fast]") {
  ConversionInput input = make_conversion();
  input.tire = "a50";
  input.from.tire_diameter_m.reset();
  const std::string command =
      "convert --force 32 --tire a50 --from-drum 2 --to-drum flat --to-tire-diameter 0.65 --from-pressure 250 "
      "--to-pressure 280 --from-ambient 25 --to-ambient 21 --load 5400 --to-load 4800";
  const ConvertedLoss converted = convert_loss(input);
  CHECK(converted.text == run_program(command).out);
  CHECK(converted.json == run_program(command + " --json -").out);
  CHECK(converted.factors.size() == 5);  // drum, tire diameter, pressure, air, load
  input.pressure_exponent = 0.5;
  CHECK(convert_loss(input).json == run_program(command + " --pressure-exponent 0.5 --json -").out);
  input.load_exponent = 0.9;
  input.diameter_exponent = 0.62;
  input.ambient_coefficient_per_K = 0.006;
  const std::string laws = " --pressure-exponent 0.5 --load-exponent 0.9 --diameter-exponent 0.62";
  CHECK(convert_loss(input).json == run_program(command + laws + " --ambient-coefficient 0.006 --json -").out);
}

TEST_CASE("a converted loss, converted back, is the measured one, as force and as RRc", "[fast]") {
  const ConversionInput there = make_conversion();
  const ConvertedLoss wanted = convert_loss(there);
  CHECK(*wanted.given.rrc_N_per_kN == Approx(32.0 / 5.4));
  CHECK(*wanted.result.rrc_N_per_kN == Approx(*wanted.result.force_N / 4.8));
  ConversionInput back = there;
  std::swap(back.from, back.to);
  back.loss = {{}, wanted.result.rrc_N_per_kN};
  const ConvertedLoss again = convert_loss(back);
  CHECK(*again.given.force_N == Approx(*wanted.result.force_N));
  CHECK(*again.result.force_N == Approx(32.0));
  CHECK(*again.result.rrc_N_per_kN == Approx(*wanted.given.rrc_N_per_kN));
}

TEST_CASE("a loss is smaller on the flat road, at a higher pressure and in warmer air", "[fast]") {
  const auto convert = [](const rollrig::LossConditions& to) {
    ConversionInput input = make_conversion();
    input.to = to;
    if (!to.drum_curvature_per_m.has_value()) input.from.drum_curvature_per_m.reset();
    if (!to.pressure_Pa.has_value()) input.from.pressure_Pa.reset();
    if (!to.ambient_K.has_value()) input.from.ambient_K.reset();
    return *convert_loss(input).result.force_N;
  };
  CHECK(convert({0.0, {}, {}, {}, {}}) < 32.0);
  CHECK(convert({{}, {}, 280e3, {}, {}}) < 32.0);
  CHECK(convert({{}, {}, {}, 29.0 + kZeroCelsius_K, {}}) < 32.0);
  CHECK(convert({}) == 32.0);
}

TEST_CASE("an exponent or coefficient whose condition is not given is refused, and named", "[fast]") {
  ConversionInput input;
  input.loss.force_N = 32.0;
  CHECK(find_refused(input).empty());
  const auto refused = [&input](const auto& change) {
    ConversionInput changed = input;
    change(changed);
    return find_refused(changed);
  };
  CHECK(refused([](auto& changed) { changed.pressure_exponent = 0.5; }) == "--pressure-exponent");
  CHECK(refused([](auto& changed) { changed.load_exponent = 0.9; }) == "--load-exponent");
  CHECK(refused([](auto& changed) { changed.diameter_exponent = 0.5; }) == "--diameter-exponent");
  CHECK(refused([](auto& changed) { changed.ambient_coefficient_per_K = 0.006; }) == "--ambient-coefficient");
}

TEST_CASE("a conversion that has no sense is refused, and the option is named", "[fast]") {
  CHECK(find_refused(make_conversion()).empty());
  const auto refused = [](const auto& change) {
    ConversionInput input = make_conversion();
    change(input);
    return find_refused(input);
  };
  CHECK(refused([](auto& input) { input.loss = {}; }) == "--force");
  CHECK(refused([](auto& input) { input.loss.rrc_N_per_kN = 6.0; }) == "--force");
  CHECK(refused([](auto& input) { input.loss = {{}, -6.0}; }) == "--rrc");
  CHECK(refused([](auto& input) { input.from.pressure_Pa.reset(); }) == "--from-pressure");
  CHECK(refused([](auto& input) { input.to.pressure_Pa = 0.0; }) == "--to-pressure");
  CHECK(refused([](auto& input) { input.to.ambient_K = 25.0; }) == "--to-ambient");
  CHECK(refused([](auto& input) { input.to.drum_curvature_per_m = -1.0; }) == "--to-drum");
  CHECK(refused([](auto& input) { input.from.load_N.reset(); }) == "--load");
  CHECK(refused([](auto& input) { input.from.tire_diameter_m.reset(); }) == "--tire-diameter");
  CHECK(refused([](auto& input) { input.load_exponent = -1.0; }) == "--load-exponent");
  CHECK(refused([](auto& input) { input.ambient_coefficient_per_K = 0.8; }) == "--ambient-coefficient");
  // Numbers whose factors or products would overflow.
  for (const double extreme : {1e-300, 1e300}) {
    CHECK(refused([=](auto& input) { input.loss.force_N = extreme; }) == "--force");
    CHECK(refused([=](auto& input) { input.loss = {{}, extreme}; }) == "--rrc");
    CHECK(refused([=](auto& input) { input.from.load_N = extreme; }) == "--load");
    CHECK(refused([=](auto& input) { input.to.load_N = extreme; }) == "--to-load");
    CHECK(refused([=](auto& input) { input.from.pressure_Pa = extreme; }) == "--from-pressure");
    CHECK(refused([=](auto& input) { input.to.tire_diameter_m = extreme; }) == "--to-tire-diameter");
  }
  CHECK(refused([](auto& input) { input.from.drum_curvature_per_m = 1e300; }) == "--from-drum");
  const auto overflow = run_program("convert --force 1e308 --from-pressure 250 --to-pressure 1e-300");
  CHECK(overflow.status == 2);
  CHECK(overflow.out.empty());
  CHECK(overflow.err.find("--force") != std::string::npos);
  ConversionInput unknown = make_conversion();
  unknown.tire = "a5O";
  CHECK_THROWS_AS(convert_loss(unknown), rollrig::InputError);
}
