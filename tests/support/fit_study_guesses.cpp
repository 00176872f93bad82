#include "tests/support/fit_study_guesses.h"

#include "estimation/tire_fit/fit_unknowns.h"
#include "models/tire/tire_model.h"
#include "sim/core/random.h"

namespace rollrig::tests {
namespace {

using estimation::FreeParameter;

estimation::FitUnknowns find_unknowns(const measurements::MeasurementSet& truth) {
  std::optional<estimation::TwoStepEstimate> two_step;
  if (truth.tire.values.model().info.follows_speed_lines()) two_step = estimation::estimate_in_two_steps(truth);
  const bool gas_measured = truth.runs[0].has(models::quantities::kGasTemperature);
  return estimation::choose_unknowns(truth, two_step, false, gas_measured);
}

/// One draw of all guesses.
models::Context<double> draw(const measurements::MeasurementSet& truth, const estimation::FitUnknowns& unknowns,
                             RandomStream& random) {
  constexpr double kOff = 0.15;
  models::Context<double> context = measurements::make_context(truth);
  const Eigen::MatrixXd factor = estimation::calc_prior_factor(unknowns.parameters);
  Eigen::VectorXd independent(factor.rows());
  for (double& u : independent) u = random.normal();
  const Eigen::VectorXd standard = factor * independent;
  Eigen::Index prior = 0;
  for (const FreeParameter& parameter : unknowns.parameters) {
    double& number = estimation::find_parameter(context, parameter.key);
    if (parameter.prior_sd_SI > 0.0) {
      number += parameter.prior_sd_SI * standard[prior++];
    } else {
      number *= 1.0 + kOff * random.normal();
    }
  }
  return context;
}

bool is_allowed(models::Context<double> context, const estimation::FitUnknowns& unknowns) {
  for (const FreeParameter& parameter : unknowns.parameters) {
    const double number = estimation::find_parameter(context, parameter.key);
    if (number < parameter.lower_SI || number > parameter.upper_SI) return false;
  }
  const models::TireModelInfo& model = context.tire.model().info;
  return model.find_mistake == nullptr || !model.find_mistake(context.tire.own).has_value();
}

/// Of f, as far as the files give it.
std::optional<double> find_given_sd(const estimation::FitUnknowns& unknowns) {
  for (const FreeParameter& parameter : unknowns.parameters) {
    const bool given = parameter.prior_sd_SI > 0.0 && unknowns.of_class.count(parameter.key) == 0;
    if (parameter.key == "tire.thermal.f_W_s_per_m_K" && given) return parameter.prior_sd_SI;
  }
  return std::nullopt;
}

void put_conductances(measurements::MeasurementSet& set, const models::Context<double>& context,
                      std::optional<double> speed_sd) {
  const models::TireThermalParameters<double>& thermal = context.tire.thermal;
  set.tire.rig_thermal[set.rig->thermal_name()] = {thermal.rest_conductance_W_per_K, std::nullopt,
                                                   thermal.speed_conductance_W_s_per_m_K, speed_sd};
}

}  // namespace

measurements::MeasurementSet guess_numbers(const measurements::MeasurementSet& truth, std::uint64_t seed) {
  const estimation::FitUnknowns unknowns = find_unknowns(truth);
  RandomStream random(seed, "guesses");
  models::Context<double> context = draw(truth, unknowns, random);
  while (!is_allowed(context, unknowns)) context = draw(truth, unknowns, random);
  measurements::MeasurementSet guessed = truth;
  models::TireParameters<double>& values = guessed.tire.values;
  values.rolling_resistance = context.tire.rolling_resistance;
  values.own = context.tire.own;
  values.thermal = context.tire.thermal;
  guessed.rig->parasitic = context.parasitic;
  put_conductances(guessed, context, find_given_sd(unknowns));
  return guessed;
}

void forget_uncertainties(measurements::MeasurementSet& set) {
  models::TireParameters<double>& sd = set.tire.standard_uncertainties;
  sd.own.values.assign(sd.own.values.size(), 0.0);
  sd.rolling_resistance = {};
  sd.thermal = {};
  set.tire.correlation = {};
  put_conductances(set, measurements::make_context(set), std::nullopt);
}

void thin(measurements::MeasurementSet& set, std::size_t every) {
  const auto keep = [every](std::vector<double>& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); i += every) values[kept++] = values[i];
    values.resize(kept);
  };
  for (measurements::MeasuredRun& run : set.runs) {
    keep(run.time_s);
    for (auto& [channel, values] : run.columns) keep(values);
  }
}

}  // namespace rollrig::tests
