// Uncertainty of the deceleration method: the scatter is that of the fit's own intervals, the instruments count as the
// equation says, and what is not known adds no line.
#include "estimation/drum_deceleration/coast_uncertainty.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "build_paths.h"
#include "estimation/uncertainty/uncertainty.h"
#include "include/rollrig/error.h"

namespace {

using namespace rollrig;
using namespace rollrig::estimation;

CoastSet read_example() {
  return read_coast_set(std::string(ROLLRIG_SOURCE_DIR) + "/assets/examples/drum_coastdown/coasts.toml");
}

/// Inputs as they are, but one.
std::vector<double> move_input(const MeasurementModel& model, const std::string& name, double factor) {
  std::vector<double> x;
  for (const UncertainInput& input : model.inputs) x.push_back(input.value * (input.name == name ? factor : 1.0));
  return x;
}

const SpeedPoint& find_reference(const CoastSet& set, const DrumCoastdownFit& fit) {
  for (const SpeedPoint& point : fit.points) {
    if (std::fabs(point.speed_m_s - set.reference_speed_m_s) < 1e-6) return point;
  }
  throw std::logic_error("no reference speed");
}

}  // namespace

TEST_CASE("the scatter of a coast-down's budget is that of the fit's intervals", "[fast]") {
  const CoastSet set = read_example();
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  const MeasurementModel model = make_coast_model(set, fit);
  const SpeedPoint& point = find_reference(set, fit);
  const Json json = make_uncertainty_json(calc_uncertainty(model, {}, {}));
  for (std::size_t i = 0; i < point.levels.size(); ++i) {
    INFO(i);
    const Json& budget = json["budgets"][i];
    CHECK(budget["value"].get<double>() == Approx(point.levels[i].force_N->value).epsilon(1e-9));
    double scatter = 0.0, instruments = 0.0;
    for (const Json& line : budget["contributions"]) {
      const double part = std::pow(line["contribution"].get<double>(), 2);
      (line["type"] == "A" ? scatter : instruments) += part;
    }
    CHECK(std::sqrt(scatter) == Approx(point.levels[i].force_N->sd).epsilon(0.01));
    CHECK(instruments > 0.0);
  }
  REQUIRE(model.measurands.size() == point.levels.size() + 1);
  CHECK(json["budgets"].back()["value"].get<double>() == Approx(point.pressure_exponent->value).epsilon(1e-9));
  CHECK(json["budgets"].back()["combined_standard_uncertainty"].get<double>() >= point.pressure_exponent->sd);
}

TEST_CASE("a coast-down's force follows inertia, drum and speed as its equation says", "[fast]") {
  CoastSet set = read_example();
  set.wheel_inertia_kg_m2.reset();
  set.wheel_mass_ratio.reset();
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  const MeasurementModel model = make_coast_model(set, fit);
  const double usual_N = model.evaluate(move_input(model, "", 1.0)).front();
  CHECK(model.evaluate(move_input(model, "inertia of the drum", 1.1)).front() == Approx(1.1 * usual_N));
  CHECK(model.evaluate(move_input(model, "diameter of the drum", 2.0)).front() == Approx(usual_N / 4.0));
  CHECK(model.evaluate(move_input(model, "speed", 1.02)).front() == Approx(1.02 * usual_N));
  CHECK(model.left_out.size() == 4);  // the losses of the wheel stay in the force
}

TEST_CASE("without an inertia, a coast-down has uncertainties of decelerations", "[fast]") {
  CoastSet set = read_example();
  set.drum_inertia_kg_m2.reset();
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  const MeasurementModel model = make_coast_model(set, fit);
  CHECK(model.measurands.front().key == "net_deceleration_m_s2");
  CHECK(model.evaluate(move_input(model, "", 1.0)).front() ==
        Approx(find_reference(set, fit).levels.front().net_m_s2.value).epsilon(1e-9));
}

TEST_CASE("an uncertainty of a coast-down asks for a result at the reference speed", "[fast]") {
  CoastSet set = read_example();
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  set.reference_speed_m_s += 1.0;
  CHECK_THROWS_AS(make_coast_model(set, fit), InputError);
}

TEST_CASE("Monte Carlo of a coast-down agrees with its budget where the scatter is well known", "[fast]") {
  const CoastSet set = read_example();
  MeasurementModel model = make_coast_model(set, fit_drum_coastdown(set));
  for (UncertainInput& input : model.inputs) {  // as if there were many runs
    input.degrees_freedom = std::numeric_limits<double>::infinity();
    if (input.distribution != Distribution::kRectangular) input.distribution = Distribution::kNormal;
  }
  const Json json = make_uncertainty_json(calc_uncertainty(model, {20000, 3, 2}, {}));
  for (std::size_t i = 0; i < model.measurands.size(); ++i) {
    INFO(model.measurands[i].name);
    const Json& trial = json["monte_carlo"]["results"][i];
    const Json& budget = json["budgets"][i];
    const double half = budget["expanded_uncertainty"].get<double>();
    CHECK(trial["mean"].get<double>() == Approx(budget["value"].get<double>()).margin(0.05 * half));
    CHECK(trial["high_95"].get<double>() - trial["low_95"].get<double>() == Approx(2.0 * half).epsilon(0.03));
  }
}
