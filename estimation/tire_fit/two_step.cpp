#include "estimation/tire_fit/two_step.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "estimation/tire_fit/set_variety.h"
#include "measurements/sample_selection.h"
#include "models/tire/drum_curvature.h"
#include "models/tire/inflation_gas.h"
#include "models/tire/rolling_resistance.h"

namespace rollrig::estimation {
namespace {

namespace quantities = models::quantities;

constexpr double kSameSpeed = 0.02;         // Assumed: speeds within 2 % are one speed
constexpr std::size_t kEnoughSamples = 30;  // Assumed: for a straight line

/// ln of the loss at reference pressure and load, and the temperature it belongs to.
struct LossSamples {
  double speed_m_s = 0.0;
  std::vector<double> temperature_dK;  // above 0 degC
  std::vector<double> log_loss;
};

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// a and b of y = a x_1 + b x_2 by least squares.
Eigen::Vector2d fit_two(const Eigen::VectorXd& x_1, const Eigen::VectorXd& x_2, const Eigen::VectorXd& y) {
  Eigen::MatrixXd design(y.size(), 2);
  design << x_1, x_2;
  return design.colPivHouseholderQr().solve(y);
}

LossSamples& find_speed(std::vector<LossSamples>& speeds, double speed_m_s) {
  for (LossSamples& known : speeds) {
    if (std::abs(known.speed_m_s - speed_m_s) <= kSameSpeed * known.speed_m_s) return known;
  }
  speeds.push_back({speed_m_s, {}, {}});
  return speeds.back();
}

/// K of drum_curvature.h: the rig's drum against the one on which A0 and A1 hold.
double find_curvature_factor(const measurements::MeasurementSet& set) {
  return models::calc_drum_correction(2.0 / set.tire.values.rolling_resistance.reference_drum_diameter_m,
                                      set.rig->curvature_per_m(), set.tire.values.geometry.outer_diameter_m / 2.0);
}

/// Pressure as measured, or by the gas law at the tire's temperature where it was not.
double find_pressure_Pa(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run, std::size_t row,
                        double tire_K) {
  if (run.has(quantities::kCavityPressure)) {
    const double measured_Pa = run.column(quantities::kCavityPressure)[row];
    if (!std::isnan(measured_Pa)) return measured_Pa;
  }
  const models::Inflation<double> inflation{run.cold_pressure_Pa, run.initial_tire_temperature_K,
                                            set.rig->environment.ambient_pressure_Pa};
  return models::calc_gauge_pressure_Pa(inflation, tire_K, 1.0, 1.0);
}

void collect_losses(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                    std::vector<LossSamples>& speeds) {
  const Quantity& force = set.kind->traits.force;
  if (!run.has(force) || !run.has(quantities::kLinerTemperature)) return;
  const auto& rr = set.tire.values.rolling_resistance;
  const std::vector<bool> settled = measurements::find_settled_rows(run);
  const std::vector<double>& load_N = run.column(quantities::kLoad);
  const std::vector<double>& speed_m_s = run.column(quantities::kSpeed);
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double force_N = run.column(force)[row] / set.rig->lever_m();
    const double liner_K = run.column(quantities::kLinerTemperature)[row];
    const bool loaded = load_N[row] > measurements::kLoadedShare * rr.reference_load_N;
    const bool steady_speed =
        std::abs(measurements::find_acceleration(run, row)) < measurements::kSteadyAcceleration_m_s2;
    if (!settled[row] || !loaded || !steady_speed || std::isnan(force_N) || std::isnan(liner_K)) continue;
    const double loss_N = force_N - models::calc_parasitic_N(set.rig->parasitic, speed_m_s[row]);
    if (loss_N <= 0.0) continue;
    const double at_reference_N =
        loss_N / find_curvature_factor(set) * rr.reference_load_N / load_N[row] *
        std::pow(find_pressure_Pa(set, run, row, liner_K) / rr.reference_pressure_Pa, rr.pressure_exponent);
    LossSamples& samples = find_speed(speeds, speed_m_s[row]);
    samples.temperature_dK.push_back(liner_K - kZeroCelsius_K);
    samples.log_loss.push_back(std::log(at_reference_N));
  }
}

SpeedFit fit_speed(const LossSamples& samples) {
  const auto log_loss = as_vector(samples.log_loss);
  const Eigen::Vector2d line =
      fit_two(Eigen::VectorXd::Ones(log_loss.size()), -as_vector(samples.temperature_dK), log_loss);
  return {samples.speed_m_s, std::exp(line[0]), line[1]};
}

void fit_over_speed(TwoStepEstimate& estimate) {
  const auto n = static_cast<Eigen::Index>(estimate.speeds.size());
  Eigen::MatrixXd design(n, 2);
  Eigen::MatrixXd coefficients(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SpeedFit& fit = estimate.speeds[static_cast<std::size_t>(i)];
    design.row(i) << 1.0, fit.speed_m_s;
    coefficients.row(i) << fit.A_N, fit.B_per_K;
  }
  const Eigen::Matrix2d lines = design.colPivHouseholderQr().solve(coefficients);
  estimate.A0_N = lines(0, 0);
  estimate.A1_N_s_per_m = lines(1, 0);
  estimate.B0_per_K = lines(0, 1);
  estimate.B1_s_per_m_K = lines(1, 1);
}

/// Lines with the slopes of the file through the mean of what was found.
void put_beside_slopes(const models::SpeedLines<double>& file, TwoStepEstimate& estimate) {
  static_cast<models::SpeedLines<double>&>(estimate) = file;
  estimate.A0_N = estimate.B0_per_K = 0.0;
  const auto n = static_cast<double>(estimate.speeds.size());
  for (const SpeedFit& fit : estimate.speeds) {
    estimate.A0_N += (fit.A_N - file.A1_N_s_per_m * fit.speed_m_s) / n;
    estimate.B0_per_K += (fit.B_per_K - file.B1_s_per_m_K * fit.speed_m_s) / n;
  }
}

/// Rows of the integrated heat balances, one a sample.
struct HeatBalance {
  std::vector<double> to_z, to_f, heat_J;        // z to_z + f to_f = heat
  std::vector<double> to_H, time_s, gas_heat_J;  // H to_H + H b time = gas heat, b: one sensor's offset to the other
};

void collect_heat(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                  const TwoStepEstimate& estimate, HeatBalance& balance) {
  if (!run.has(quantities::kLinerTemperature)) return;
  const auto& thermal = set.tire.values.thermal;
  const bool gas_measured = run.has(quantities::kGasTemperature);
  models::TireParameters<double> tire = set.tire.values;
  static_cast<models::SpeedLines<double>&>(tire.rolling_resistance) = estimate;
  const std::vector<double>& liner = run.column(quantities::kLinerTemperature);
  const std::vector<double>& ambient_K = run.column(quantities::kAmbient);
  const std::vector<double>& speed_m_s = run.column(quantities::kSpeed);
  const std::vector<double>& load_N = run.column(quantities::kLoad);
  double z_integral = 0.0, f_integral = 0.0, generated_J = 0.0, H_integral = 0.0;
  double tire_K = run.initial_tire_temperature_K;
  double gas_K = tire_K;
  for (std::size_t row = 0; row + 1 < run.time_s.size(); ++row) {
    const double step_s = run.time_s[row + 1] - run.time_s[row];
    if (!std::isnan(liner[row])) tire_K = liner[row];
    gas_K += step_s * thermal.H_gas_W_per_K / thermal.gas_heat_capacity_J_per_K * (tire_K - gas_K);
    if (gas_measured && !std::isnan(run.column(quantities::kGasTemperature)[row])) {
      gas_K = run.column(quantities::kGasTemperature)[row];
    }
    const double loss_N =
        find_curvature_factor(set) * models::calc_rolling_resistance_N(tire, speed_m_s[row], load_N[row],
                                                                       find_pressure_Pa(set, run, row, tire_K), tire_K);
    generated_J += step_s * loss_N * speed_m_s[row];
    z_integral += step_s * (tire_K - ambient_K[row]);
    f_integral += step_s * speed_m_s[row] * (tire_K - ambient_K[row]);
    H_integral += step_s * (tire_K - gas_K);
    const double rise_dK = tire_K - run.initial_tire_temperature_K;
    const double gas_heat_J = thermal.gas_heat_capacity_J_per_K * (gas_K - run.initial_tire_temperature_K);
    balance.to_z.push_back(z_integral);
    balance.to_f.push_back(f_integral);
    balance.heat_J.push_back(generated_J - thermal.heat_capacity_J_per_K * rise_dK - gas_heat_J);
    if (gas_measured) {
      balance.to_H.push_back(H_integral);
      balance.time_s.push_back(run.time_s[row + 1] - run.time_s.front());
      balance.gas_heat_J.push_back(gas_heat_J);
    }
  }
}

/// z of z to_z + f to_f = heat, where f is known.
double fit_rest_conductance(const HeatBalance& balance, double speed_conductance_W_s_per_m_K) {
  const auto to_z = as_vector(balance.to_z);
  const Eigen::VectorXd left_J = as_vector(balance.heat_J) - speed_conductance_W_s_per_m_K * as_vector(balance.to_f);
  return to_z.dot(left_J) / to_z.squaredNorm();
}

void fit_heat(const measurements::MeasurementSet& set, TwoStepEstimate& estimate) {
  HeatBalance balance;
  for (const measurements::MeasuredRun& run : set.runs) collect_heat(set, run, estimate, balance);
  if (estimate.slopes_held) {
    estimate.speed_conductance_W_s_per_m_K = set.tire.parameters_on(set.rig->cooling_rig(), models::Baseline::kCombined)
                                                 .thermal.speed_conductance_W_s_per_m_K;
    estimate.rest_conductance_W_per_K = fit_rest_conductance(balance, estimate.speed_conductance_W_s_per_m_K);
  } else {
    const Eigen::Vector2d conductances =
        fit_two(as_vector(balance.to_z), as_vector(balance.to_f), as_vector(balance.heat_J));
    estimate.rest_conductance_W_per_K = conductances[0];
    estimate.speed_conductance_W_s_per_m_K = conductances[1];
  }
  if (balance.to_H.empty()) return;
  estimate.H_gas_W_per_K =
      fit_two(as_vector(balance.to_H), as_vector(balance.time_s), as_vector(balance.gas_heat_J))[0];
}

InputError no_speed(const measurements::MeasurementSet& set) {
  return InputError({"the set has no speed with loss and temperature, of which A and B are found", set.path, 0,
                     "speed_km_h", "",
                     fmt::format("a loaded run at a constant speed above 20 km/h with {} and {}",
                                 set.kind->traits.force.header(), Quantity(quantities::kLinerTemperature).header()),
                     ""});
}

}  // namespace

double TwoStepEstimate::mean_speed_m_s() const {
  double sum_m_s = 0.0;
  for (const SpeedFit& fit : speeds) sum_m_s += fit.speed_m_s;
  return sum_m_s / static_cast<double>(speeds.size());
}

TwoStepEstimate estimate_in_two_steps(const measurements::MeasurementSet& set) {
  std::vector<LossSamples> speeds;
  for (const measurements::MeasuredRun& run : set.runs) collect_losses(set, run, speeds);
  speeds.erase(std::remove_if(speeds.begin(), speeds.end(),
                              [](const LossSamples& s) { return s.log_loss.size() < kEnoughSamples; }),
               speeds.end());
  if (speeds.empty()) throw no_speed(set);
  TwoStepEstimate estimate;
  for (const LossSamples& samples : speeds) estimate.speeds.push_back(fit_speed(samples));
  std::sort(estimate.speeds.begin(), estimate.speeds.end(),
            [](const SpeedFit& a, const SpeedFit& b) { return a.speed_m_s < b.speed_m_s; });
  estimate.slopes_held = estimate.speeds.size() < 2 || !find_variety(set).speeds;
  if (estimate.slopes_held) {
    put_beside_slopes(set.tire.values.rolling_resistance, estimate);
  } else {
    fit_over_speed(estimate);
  }
  fit_heat(set, estimate);
  return estimate;
}

}  // namespace rollrig::estimation
