// Uncertainty of the deceleration method: the scatter is that of the fit's own intervals, the instruments count as the
// equation says, and what is not known adds no line.
#include "estimation/drum_deceleration/coast_uncertainty.h"

#include <algorithm>
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

double calc_usual(const MeasurementModel& model) { return model.evaluate(move_input(model, "", 1.0)).front(); }

bool doubts_units_of(const DrumCoastdownFit& fit, const std::string& words) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                     [&words](const std::string& warning) { return warning.find(words) != std::string::npos; });
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
  double scatter = 0.0;
  for (const Json& line : json["budgets"].back()["contributions"]) {
    if (line["type"] == "A") scatter += std::pow(line["contribution"].get<double>(), 2);
  }
  // The fit takes one relative scatter for all pressures, the budget that of each.
  CHECK(std::sqrt(scatter) == Approx(point.pressure_exponent->sd).epsilon(0.02));
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

TEST_CASE("the uncertainty of a coast-down is that at the speed nearest to the reference, which must have a result",
          "[fast]") {
  CoastSet set = read_example();
  DrumCoastdownFit fit = fit_drum_coastdown(set);
  const double usual_N = calc_usual(make_coast_model(set, fit));
  set.reference_speed_m_s += 0.5;
  CHECK(calc_usual(make_coast_model(set, fit)) == usual_N);
  for (SpeedPoint& point : fit.points) point.levels.clear();
  CHECK_THROWS_AS(make_coast_model(set, fit), InputError);
}

TEST_CASE("of two pressures, the scatter of the runs is that of the exponent", "[fast]") {
  CoastSet set = read_example();
  const double first_Pa = find_reference(set, fit_drum_coastdown(set)).levels.front().pressure_Pa;
  const auto is_first = [&](const CoastRun& run) {
    return run.state == CoastState::kLoaded && is_same_pressure(run.pressure_Pa, first_Pa);
  };
  set.runs.erase(std::remove_if(set.runs.begin(), set.runs.end(), is_first), set.runs.end());
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  const SpeedPoint& point = find_reference(set, fit);
  REQUIRE(point.levels.size() == 2);
  const Json budget = make_uncertainty_json(calc_uncertainty(make_coast_model(set, fit), {}, {}))["budgets"].back();
  CHECK(budget["value"].get<double>() == Approx(point.pressure_exponent->value).epsilon(1e-9));
  CHECK(budget["combined_standard_uncertainty"].get<double>() == Approx(point.pressure_exponent->sd).epsilon(0.05));
}

TEST_CASE("coast-downs in other units than the set says are refused or doubted", "[fast]") {
  const CoastSet good = read_example();
  CHECK(!doubts_units_of(fit_drum_coastdown(good), "units"));
  CoastSet tonnes = good;
  tonnes.drum_inertia_kg_m2 = 1e-3 * *good.drum_inertia_kg_m2;
  CHECK_THROWS_AS(fit_drum_coastdown(tonnes), InputError);
  CoastSet feet = good;
  feet.drum_diameter_m = good.drum_diameter_m / 0.0254;
  CHECK_THROWS_AS(fit_drum_coastdown(feet), InputError);
  CoastSet pounds = good;
  pounds.drum_inertia_kg_m2 = 23.73 * *good.drum_inertia_kg_m2;  // lb ft2
  for (CoastRun& run : pounds.runs) run.load_N = run.state == CoastState::kLoaded ? 4000.0 : 0.0;
  CHECK_THROWS_AS(fit_drum_coastdown(pounds), InputError);
  for (CoastRun& run : pounds.runs) run.load_N = 0.0;
  CHECK(doubts_units_of(fit_drum_coastdown(pounds), "units"));
  CoastSet kilograms = good;
  for (CoastRun& run : kilograms.runs) run.load_N = run.state == CoastState::kLoaded ? 490.0 : 0.0;
  CHECK_THROWS_AS(fit_drum_coastdown(kilograms), InputError);
  CoastSet psi = good;
  for (CoastRun& run : psi.runs) run.pressure_Pa /= 6.895;
  psi.reference_pressure_Pa.reset();
  CHECK(doubts_units_of(fit_drum_coastdown(psi), "psi"));
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
