#include "tests/diagnosis/gap_sets.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <random>
#include "measurements/resimulation.h"
#include "measurements/sensor_file.h"
#include "sim/core/error.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

namespace rollrig::tests {
namespace {

/// What is done in a run, with straight lines between the points of the speed.
struct Plan {
  double steady_s;  // at 80 km/h
  double fast_km_h;
  double fast_s;
  double load_N;
};

constexpr double kSkim_s = 300.0;
constexpr double kRamp_s = 40.0;
constexpr double kSteady_m_s = 80.0 / 3.6;

measurements::MeasuredRun plan_run(const Plan& plan, double skim_load_N) {
  measurements::MeasuredRun run;
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 280e3;
  const double fast_m_s = plan.fast_km_h / 3.6;
  const double ramp_begins_s = kSkim_s + plan.steady_s;
  const double unloaded_s = ramp_begins_s + kRamp_s + plan.fast_s;
  for (double time_s = 0.0; time_s < unloaded_s + kSkim_s; time_s += 1.0) {
    const double share = std::clamp((time_s - ramp_begins_s) / kRamp_s, 0.0, 1.0);
    const bool loaded = time_s >= kSkim_s && time_s < unloaded_s;
    run.time_s.push_back(time_s);
    run.columns["speed_km_h"].push_back(kSteady_m_s + share * (fast_m_s - kSteady_m_s));
    run.columns["load_N"].push_back(loaded ? plan.load_N : skim_load_N);
    run.columns["ambient_degC"].push_back(298.15);
  }
  return run;
}

void fill_measured(const measurements::MeasurementSet& set, const std::vector<models::ActiveEffect>& effects,
                   measurements::MeasuredRun& run) {
  models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), effects);
  const auto recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
  for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
}

}  // namespace

measurements::MeasurementSet make_gap_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                          const std::string& sensors) {
  const std::vector<Plan> plans{{1400.0, 110.0, 1000.0, 5400.0}, {1500.0, 120.0, 800.0, 4200.0},
                                {1600.0, 100.0, 1200.0, 3000.0}, {700.0, 120.0, 660.0, 5400.0},
                                {1200.0, 100.0, 1460.0, 4200.0}, {1300.0, 130.0, 900.0, 5400.0}};
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.tire = read_combined_tire();
  set.rig = make_uneven_drum();
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset(sensors);
  for (std::size_t i = 0; i < runs; ++i) {
    measurements::MeasuredRun run = plan_run(plans[i], set.rig->skim.load_N);
    run.id = "run_" + std::to_string(i + 1);
    run.session = i % 2 == 0 ? "morning" : "evening";
    fill_measured(set, effects, run);
    set.runs.push_back(std::move(run));
  }
  return set;
}

FittedBaseline::FittedBaseline(const measurements::MeasurementSet& measured) : Study(measured) {
  diagnosis::compare_models(*this);
}

RepeatedBaseline::RepeatedBaseline(const measurements::MeasurementSet& clean) : clean_(clean) {
  const diagnosis::Study study(clean_);
  const diagnosis::Model model = study.make_model({});
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.unknown_count()));
  Eigen::VectorXd residuals;
  if (!model.simulate(middle, 0, simulated_, &derivatives_) || !model.evaluate(middle, 0, residuals, &jacobian_)) {
    throw RunFailure("the baseline cannot be simulated");
  }
}

std::unique_ptr<diagnosis::Study> RepeatedBaseline::draw(
    std::uint64_t seed, const std::function<void(measurements::MeasurementSet&)>& change) const {
  measurements::MeasurementSet measured = clean_;
  if (change) change(measured);
  diagnosis::StudySettings settings;
  settings.threads = 1;
  auto draw = std::make_unique<diagnosis::Study>(add_noise(measured, seed), settings);

  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd base_error(derivatives_.cols());
  for (double& u : base_error) u = normal(random);
  // A simulator whose base parameters lie off the truth by that.
  const Eigen::VectorXd simulated = simulated_ - derivatives_ * base_error;

  diagnosis::Fit& fit = draw->null.fit;
  Eigen::VectorXd difference = -simulated;
  for (const diagnosis::Series& series : draw->set.series()) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      difference[static_cast<Eigen::Index>(series.first_residual + k)] += series.measured[k];
    }
  }
  diagnosis::whiten(draw->set, difference);
  const Eigen::Index n = jacobian_.cols();
  fit.jacobian = jacobian_;
  fit.unknowns = -(jacobian_.transpose() * jacobian_ + Eigen::MatrixXd::Identity(n, n))
                      .llt()
                      .solve(jacobian_.transpose() * difference);
  fit.residuals = difference + jacobian_ * fit.unknowns;
  fit.simulated = simulated + derivatives_ * fit.unknowns.head(derivatives_.cols());
  draw->null.amplitudes.assign(draw->set.channels().size(), 0.0);
  return draw;
}

void add_to_channel(measurements::MeasuredRun& run, const std::string& channel,
                    const std::function<double(double time_s)>& error) {
  for (std::size_t row = 0; row < run.time_s.size(); ++row) run.columns.at(channel)[row] += error(run.time_s[row]);
}

}  // namespace rollrig::tests
