#include "tests/diagnosis/compared_set.h"

#include <algorithm>

#include "measurements/resimulation.h"
#include "measurements/sensor_file.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

namespace rollrig::tests {

using namespace rollrig::diagnosis;

namespace {

StudySettings with_terms(const std::vector<std::string>& terms) {
  StudySettings settings;
  for (const std::string& id : terms) settings.terms.push_back(&find_term(id));
  return settings;
}

}  // namespace

models::ActiveEffect act(const std::string& id, double size) {
  const models::Effect& effect = models::find_effect(id);
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) values.push_back(parameter.prior.center());
  values.front() *= size;
  return make_active(effect, values);
}

measurements::MeasuredRun plan_skim_run() {
  measurements::MeasuredRun run;
  run.id = "warm-up";
  run.session = "day";
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 280e3;
  constexpr double kSkim_s = 180.0;
  constexpr double kLoaded_s = 1500.0;
  for (double time_s = 0.0; time_s < 2.0 * kSkim_s + kLoaded_s; time_s += 1.0) {
    const bool loaded = time_s >= kSkim_s && time_s < kSkim_s + kLoaded_s;
    run.time_s.push_back(time_s);
    run.columns["speed_km_h"].push_back(80.0 / 3.6);
    run.columns["load_N"].push_back(loaded ? 5400.0 : 200.0);
    run.columns["ambient_degC"].push_back(298.15);
  }
  return run;
}

measurements::MeasurementSet measure_on_drum(const std::vector<models::ActiveEffect>& effects,
                                             std::vector<measurements::MeasuredRun> runs) {
  constexpr std::uint64_t kSeed = 1;
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.tire = read_combined_tire();
  set.rig = read_asset_rig();  // where tests are nearly equally good, one drum has to be chosen
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset("source");
  for (measurements::MeasuredRun& run : runs) {
    models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), effects);
    const auto recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
    for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
    set.runs.push_back(std::move(run));
  }
  return add_noise(set, kSeed);
}

ComparedSet::ComparedSet(const measurements::MeasurementSet& measured, const std::vector<std::string>& terms)
    : study(measured, with_terms(terms)), comparison(compare_models(study)) {}

ComparedSet compare_bearings_or_zero() {
  return {measure_on_drum({act("bearing_warmup")}, {plan_skim_run()}), {"bearing_warmup", "torque_zero_drift"}};
}

const ComparedSet& bearings_or_zero() {
  static const ComparedSet compared = compare_bearings_or_zero();
  return compared;
}

std::vector<OpenHypothesis> make_open(const Study& study, const std::vector<std::string>& effects) {
  std::vector<OpenHypothesis> open;
  const double share = 1.0 / static_cast<double>(effects.size());
  for (const std::string& id : effects) {
    Hypothesis hypothesis;
    if (id != "none") hypothesis = hypothesis.with({&find_term(id), 1});
    const auto count = static_cast<Eigen::Index>(study.make_model(hypothesis).parameter_count());
    const auto base = static_cast<Eigen::Index>(study.base.size());
    Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(count, count);
    spread.bottomRightCorner(base, base) *= 0.3;  // after some measurement
    open.push_back({hypothesis, Eigen::VectorXd::Zero(count), spread, share});
  }
  return open;
}

const JudgedTest& find_judged(const std::vector<JudgedTest>& judged, const std::string& id) {
  return *std::find_if(judged.begin(), judged.end(), [&](const JudgedTest& one) { return one.test.id == id; });
}

}  // namespace rollrig::tests
