// The uncertainty of A, B, C against fits of the same coastdowns with other numbers.
#include "estimation/road_load/road_load_uncertainty.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/uncertainty/uncertainty.h"
#include "tests/support/coastdown_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using tests::CoastdownStudy;
using tests::simulate_coastdowns;

namespace {

struct Fitted {
  CoastdownData data;
  RoadLoadFitOptions options;
  RoadLoadFit fit;
  MeasurementModel model;

  explicit Fitted(const CoastdownStudy& study) : data(simulate_coastdowns(study, 1)) {
    for (CoastdownRun& run : data.runs) {
      run.conditions.ambient_K.assign(run.speed_m_s.size(), study.ambient_K);
      run.conditions.ambient_pressure_Pa.assign(run.speed_m_s.size(), study.ambient_pressure_Pa);
    }
    options.mass_kg = study.mass_kg;
    options.rotating_mass_kg = study.effective_mass_kg - study.mass_kg;
    fit = fit_road_load(data, options);
    model = make_road_load_model(data, options, fit);
  }

  std::vector<double> values() const {
    std::vector<double> values;
    for (const UncertainInput& input : model.inputs) values.push_back(input.value);
    return values;
  }
  std::size_t place(const std::string& name) const {
    INFO(name);
    std::size_t i = 0;
    while (i < model.inputs.size() && model.inputs[i].name != name) ++i;
    REQUIRE(i < model.inputs.size());
    return i;
  }
};

CoastdownStudy make_cold_study() {
  CoastdownStudy study;
  study.ambient_K = 283.15;
  study.ambient_pressure_Pa = 101e3;
  study.pairs = 3;
  return study;
}

/// The model with one input moved is the fit with that number.
void check_moved(const Fitted& base, const std::string& input, double by, const RoadLoadFit& moved) {
  std::vector<double> x = base.values();
  x[base.place(input)] += by;
  const std::vector<double> now = base.model.evaluate(x);
  const auto expected = moved.values();
  for (std::size_t i = 0; i < 3; ++i) {
    INFO(input << ", coefficient " << i);
    // The weights of the bins follow the forces, so that the fit itself moves a little otherwise.
    CHECK(now[i] == Approx(expected[i]).epsilon(2e-4));
  }
}

}  // namespace

TEST_CASE("the model of a road load gives the fit back", "[fast]") {
  const Fitted base(make_cold_study());
  const std::vector<double> now = base.model.evaluate(base.values());
  for (std::size_t i = 0; i < 3; ++i) CHECK(now[i] == Approx(base.fit.values()[i]).epsilon(1e-12));
}

TEST_CASE("mass, fall with temperature and weather act as in a fit with other numbers", "[fast]") {
  const Fitted base(make_cold_study());
  RoadLoadFitOptions heavier = base.options;
  *heavier.mass_kg += 40.0;
  check_moved(base, "mass as tested", 40.0, fit_road_load(base.data, heavier));
  RoadLoadFitOptions steeper = base.options;
  steeper.rolling_fall_per_K += 3e-3;
  check_moved(base, "fall of A and B with temperature", 3e-3, fit_road_load(base.data, steeper));
  CoastdownData warmer = base.data;
  CoastdownData denser = base.data;
  for (CoastdownRun& run : warmer.runs) {
    for (double& ambient_K : run.conditions.ambient_K) ambient_K += 2.0;
  }
  for (CoastdownRun& run : denser.runs) {
    for (double& pressure_Pa : run.conditions.ambient_pressure_Pa) pressure_Pa += 500.0;
  }
  check_moved(base, "air temperature", 2.0, fit_road_load(warmer, base.options));
  check_moved(base, "air pressure", 500.0, fit_road_load(denser, base.options));
}

TEST_CASE("a speed that reads low is a road load that is larger at a standstill", "[fast]") {
  const Fitted base(make_cold_study());
  CoastdownData faster = base.data;
  constexpr double kGain = 1.002;
  for (CoastdownRun& run : faster.runs) {
    for (double& speed_m_s : run.speed_m_s) speed_m_s *= kGain;
  }
  RoadLoadFitOptions options = base.options;
  options.speed_from_m_s *= kGain;  // the same samples
  options.bin_width_m_s *= kGain;
  check_moved(base, "gain of the speed", kGain - 1.0, fit_road_load(faster, options));
}

TEST_CASE("the scatter of the runs is that of the fit, with its correlation", "[fast]") {
  const Fitted base(make_cold_study());
  const auto budgets = calc_budgets(base.model);
  for (std::size_t i = 0; i < 3; ++i) {
    const Contribution& scatter = budgets[i].contributions[0];
    CHECK(scatter.input.name == "scatter of the runs");
    CHECK(scatter.contribution == Approx(base.fit.sd(static_cast<int>(i))).epsilon(1e-6));
  }
  std::vector<double> x = base.values();
  x[0] += 1.0;  // the first moves A by its standard deviation, and B with it by their covariance
  const std::vector<double> moved = base.model.evaluate(x);
  CHECK(moved[1] - base.fit.values()[1] == Approx(base.fit.covariance(1, 0) / base.fit.sd(0)).epsilon(1e-6));
}

TEST_CASE("what has no figure is left out of the budget by name", "[fast]") {
  CoastdownStudy study = make_cold_study();
  study.pairs = 1;
  Fitted base(study);
  CHECK(base.model.left_out.size() >= 2);
  for (CoastdownRun& run : base.data.runs) run.conditions = {};
  const RoadLoadFit fit = fit_road_load(base.data, base.options);
  const MeasurementModel model = make_road_load_model(base.data, base.options, fit);
  const auto names = [](const MeasurementModel& of, const std::string& what) {
    return std::any_of(of.left_out.begin(), of.left_out.end(),
                       [&](const std::string& one) { return one.find(what) != std::string::npos; });
  };
  CHECK(names(model, "air temperature during the test"));
  CHECK_FALSE(names(base.model, "air temperature during the test"));
}
