// A hidden cause has the size that the truth says: effects of inertia, slip, wind, tire temperature, and outside.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/run_program.h"
#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using namespace rollrig::tests;

TEST_CASE("a meter of 2 % reads 2 % more, a little less at high torque", "[fast]") {
  const GeneratedSet made = make_effect_set(with_form("drum", GENERATE("bent", "with_air")), "torque_gain", "2");
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> more_Nm = find_difference(made, r, "drum_torque_Nm");
    const std::vector<double>& true_Nm = made.counterfactual.runs[r].columns.at("drum_torque_Nm");
    for (std::size_t row = 0; row < more_Nm.size(); ++row) {
      if (std::isnan(more_Nm[row]) || std::abs(true_Nm[row]) < 5.0) continue;
      const double gain = more_Nm[row] / true_Nm[row];
      if (gain < 0.005 || gain > 0.0261) FAIL_CHECK(gain << " at " << true_Nm[row] << " N m");
    }
  }
}

TEST_CASE("2 % more inertia takes 2 % more force, late, and nothing at a constant speed", "[fast]") {
  const GeneratedSet made = make_effect_set(with_form("drum", GENERATE("rigid", "soft")), "inertia_error", "2");
  const auto& drum = made.set.rig->drum;
  const double radius_m = 0.5 * drum.diameter_m;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> torque_Nm = find_difference(made, r, "drum_torque_Nm");
    const std::vector<double>& v = made.set.runs[r].columns.at("speed_km_h");
    for (std::size_t row = 20; row + 1 < torque_Nm.size(); ++row) {
      if (std::isnan(torque_Nm[row])) continue;
      const double now_m_s2 = v[row + 1] - v[row];
      const double before_m_s2 = v[row - 14] - v[row - 15];
      if (std::abs(now_m_s2 - before_m_s2) > 1e-4) continue;  // settled for ten times the lag
      const double wanted_Nm = 0.02 * drum.inertia_kg_m2 / radius_m * now_m_s2;
      const bool same_ramp = std::abs((v[row] - v[row - 15]) / 15.0 - now_m_s2) < 1e-4;
      if (same_ramp && std::abs(torque_Nm[row] - wanted_Nm) > 0.02) {
        FAIL_CHECK(torque_Nm[row] << " N m where " << wanted_Nm << " are wanted, row " << row);
      }
    }
  }
}

TEST_CASE("slip under 1 kN costs its square over C, and more near the limit of friction", "[slow]") {
  const std::string kind = with_form("dyno", GENERATE("brush", "tanh"));
  for (int seed = 41; seed < 44; ++seed) {
    const GeneratedSet made = make_effect_set(kind, "slip_loss", "100", seed);
    const std::vector<double> loss_N = find_difference(made, 0, "loss_force_N");
    const std::vector<double>& force_N = made.set.runs[0].columns.at("longitudinal_force_N");
    int strong = 0;
    for (std::size_t row = 1; row + 1 < loss_N.size(); ++row) {
      if (std::isnan(loss_N[row])) continue;
      // A mean over the interval of a force that changes with time: between the rows' extremes. Warmer rubber
      // loses up to some newtons less.
      const auto [low, high] =
          std::minmax({std::abs(force_N[row - 1]), std::abs(force_N[row]), std::abs(force_N[row + 1])});
      strong += low > 500.0 ? 1 : 0;
      if (loss_N[row] > 1.35 * high * high / 1e5 + 0.1 || loss_N[row] < low * low / 1e5 - 6.0) {
        FAIL_CHECK("seed " << seed << ", row " << row << ": " << loss_N[row] << " N at " << force_N[row] << " N");
      }
    }
    CHECK(strong > 0);
  }
}

TEST_CASE("wind against the vehicle drags as the air of its relative speed", "[fast]") {
  const GeneratedSet made =
      make_effect_set(with_form("road", GENERATE("gusts", "turning_road")), "wind_and_grade", "4");
  const double slope = 0.01 * made.truth.at("effects")[0].at("shape").at("slope_percent_at_5_m_s").get<double>() * 0.8;
  const double side = 0.8 * made.truth.at("effects")[0].at("shape").at("drag_of_side_wind").get<double>();
  double drag_N = 0.0;
  double wanted_N = 0.0;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> more_N = find_difference(made, r, "traction_force_N");
    const std::vector<double>& v = made.set.runs[r].columns.at("speed_km_h");
    for (std::size_t row = 0; row < more_N.size(); ++row) {
      if (std::isnan(more_N[row])) continue;
      drag_N += more_N[row] - made.set.vehicle->body.mass_kg * 9.81 * slope;
      wanted_N +=
          0.6 * made.set.vehicle->body.drag_area_m2 * ((1.0 + side) * std::pow(v[row] + 4.0, 2) - v[row] * v[row]);
    }
  }
  CHECK(drag_N == Approx(wanted_N).epsilon(0.3));  // gusts, days and density
}

TEST_CASE("a tire that starts cold loses more than its warm constant, and less the longer it rolls", "[fast]") {
  const GeneratedSet made =
      make_effect_set(with_form("road", GENERATE("power", "arrhenius")), "tire_temperature", "0.02");
  CHECK(made.set.baseline == models::Baseline::kConstantRrc);
  int cold = 0;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const measurements::MeasuredRun& run = made.set.runs[r];
    if (run.initial_tire_temperature_K > 288.0) continue;
    const std::vector<double> more_N = find_difference(made, r, "traction_force_N");
    const auto mean = [&more_N](std::size_t from, std::size_t to) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t row = from; row < to; ++row) {
        if (std::isnan(more_N[row])) continue;
        sum += more_N[row];
        ++count;
      }
      return sum / count;
    };
    INFO(run.id);
    CHECK(mean(0, 120) > 10.0);
    CHECK(mean(900, more_N.size()) < mean(0, 120));
    ++cold;
  }
  CHECK(cold > 0);
}

TEST_CASE("a cylinder that sticks stays short after a rise and above after a fall", "[fast]") {
  const GeneratedSet made = make_effect_set("drum", "load_stiction", "150");
  int rises = 0;
  int falls = 0;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const std::vector<double> torque_Nm = find_difference(made, r, "drum_torque_Nm");
    const std::vector<double>& load_N = made.set.runs[r].columns.at("load_N");
    for (std::size_t row = 400; row + 60 < torque_Nm.size(); ++row) {
      const double step_N = load_N[row] - load_N[row - 1];
      if (std::abs(step_N) < 1000.0 || std::isnan(torque_Nm[row + 60])) continue;
      (step_N > 0.0 ? rises : falls) += 1;
      CHECK((step_N > 0.0) == (torque_Nm[row + 60] < 0.0));
    }
  }
  CHECK(rises > 2);
  CHECK(falls > 2);
}
