#include "diagnosis/checks/mistake_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"
#include "measurements/whitener.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

using Values = std::vector<double>;

constexpr double kFades_s = 600.0;
constexpr double kLag_s = 60.0;
constexpr double kAverage_s = 20.0;
constexpr double kSpeed_m_s = 22.2;  // 80 km/h
constexpr std::array<double, 7> kNoiseFactors{1.0, 1.5, 2.5, 5.0, 10.0, 20.0, 50.0};

/// What a channel would show where the tire does nothing, and how its tolerance splits.
struct Tolerance {
  Values rest;
  double fixed = 0.0;
  double share = 0.0;
};

Tolerance find_tolerance(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel) {
  const std::size_t rows = run.time_s.size();
  if (channel == set.kind->traits.force) {
    const MeasurementKind& kind = kind_of(set);
    constexpr double kLarge = 1e6;
    const double fixed = kind.calc_force_tolerance(set, 0.0);
    return {Values(rows, 0.0), fixed, (kind.calc_force_tolerance(set, kLarge) - fixed) / kLarge};
  }
  const models::ChannelFamily& family = models::get_tire_channel(channel).family;
  const bool is_pressure = family.rest == models::ChannelFamily::Rest::kColdPressure;
  const Values rest = is_pressure ? Values(rows, run.cold_pressure_Pa) : run.column(quantities::kAmbient);
  return {rest, family.tolerance_SI, family.share_of_rise};
}

/// Parts that a simulation may not know (columns of B), values in every row of a run.
struct Unknowns {
  std::vector<Values> scaled;
  std::vector<Values> fixed;
};

/// What the channel shows beyond its rest, as far as it is in proportion to h.
void add_moved(const MeasuredRun& run, const Tolerance& tolerance, const Values& simulated,
               std::vector<Values>& unknowns) {
  const Values& speed_m_s = run.column(quantities::kSpeed);
  const Values& load_N = run.column(quantities::kLoad);
  const double largest_N = std::max(1.0, *std::max_element(load_N.begin(), load_N.end()));
  std::vector<Values> moved(4, Values(simulated.size(), 0.0));
  for (std::size_t row = 0; row < simulated.size(); ++row) {
    const double part = tolerance.share * (simulated[row] - tolerance.rest[row]);
    moved[0][row] = part;
    moved[1][row] = part * std::exp((run.time_s.front() - run.time_s[row]) / kFades_s);
    moved[2][row] = part * (speed_m_s[row] / kSpeed_m_s - 1.0);
    moved[3][row] = part * (load_N[row] / largest_N - 0.5);
  }
  for (Values& one : moved) unknowns.push_back(std::move(one));
}

void add_lag(const MeasuredRun& run, const Values& simulated, std::vector<Values>& unknowns) {
  Values lag(simulated.size(), 0.0);
  for (std::size_t row = 1; row < simulated.size(); ++row) {
    lag[row] = kLag_s * (simulated[row] - simulated[row - 1]) / (run.time_s[row] - run.time_s[row - 1]);
  }
  unknowns.push_back(std::move(lag));
}

Unknowns list_unknowns(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel,
                       const Values& simulated) {
  const Tolerance tolerance = find_tolerance(set, run, channel);
  Unknowns unknowns;
  std::vector<Values> at_rest(3, Values(simulated.size(), tolerance.fixed));
  for (std::size_t row = 0; row < simulated.size(); ++row) {
    at_rest[1][row] *= std::exp((run.time_s.front() - run.time_s[row]) / kFades_s);
    at_rest[2][row] *= run.column(quantities::kSpeed)[row] / kSpeed_m_s;
  }
  unknowns.scaled = std::move(at_rest);
  if (channel == set.kind->traits.force) unknowns.fixed = kind_of(set).list_unknown_forces(set, run);
  if (unknowns.fixed.empty()) add_moved(run, tolerance, simulated, unknowns.scaled);
  if (channel != set.kind->traits.force) add_lag(run, simulated, unknowns.scaled);
  return unknowns;
}

/// Blocks of the samples in these rows: each of its own on the road, where every change of speed tells.
std::vector<measurements::Block> make_averages(const MeasurementSet& set, const Values& times_s) {
  std::vector<measurements::Block> blocks;
  const double length_s = models::is_on_road(set.kind->traits) ? 0.0 : kAverage_s;
  for (std::size_t first = 0, last = 0; first < times_s.size(); first = last) {
    for (last = first + 1; last < times_s.size() && times_s[last] - times_s[first] < length_s;) ++last;
    blocks.push_back({first, last});
  }
  return blocks;
}

/// The rows without those that stand far out: a spike tells nothing of units and columns.
std::vector<std::size_t> drop_spikes(const Values& measured, const Values& simulated, double noise_sd,
                                     std::vector<std::size_t> rows) {
  constexpr double kFar = 10.0;  // Assumed: times the noise, and the deviation that kUsual of the rows do not exceed
  constexpr double kUsual = 0.95;
  Values deviations;
  for (const std::size_t row : rows) deviations.push_back(std::abs(measured[row] - simulated[row]));
  const auto usual = deviations.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(rows.size() - 1));
  std::nth_element(deviations.begin(), usual, deviations.end());
  const double limit = kFar * std::max(*usual, noise_sd);
  const auto is_far = [&](std::size_t row) { return std::abs(measured[row] - simulated[row]) > limit; };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_far), rows.end());
  return rows;
}

ChannelProducts calc_channel_products(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel,
                                      const Values& simulated, const std::vector<std::size_t>& rows) {
  const Unknowns unknowns = list_unknowns(set, run, channel, simulated);
  std::vector<const Values*> parts;
  for (const Values& part : unknowns.scaled) parts.push_back(&part);
  for (const Values& part : unknowns.fixed) parts.push_back(&part);
  const Values& measured = run.column(channel);
  const Values times_s = measurements::find_times(run, rows);
  const std::vector<measurements::Block> blocks = make_averages(set, times_s);
  const models::SensorParameters& sensor = set.sensors.at(channel);
  const std::size_t columns = parts.size() + 2;
  Values values(blocks.size() * columns, 0.0);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto samples = static_cast<double>(blocks[k].last - blocks[k].first);
    double* of_block = values.data() + k * columns;
    for (std::size_t i = blocks[k].first; i < blocks[k].last; ++i) {
      of_block[0] += (measured[rows[i]] - simulated[rows[i]]) / samples;
      for (std::size_t c = 0; c < parts.size(); ++c) of_block[c + 1] += (*parts[c])[rows[i]] / samples;
    }
    of_block[columns - 1] = sensor.offset_sd;
  }
  measurements::Whitener(sensor, times_s, blocks).apply(values.data(), columns);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(values.data(), static_cast<Eigen::Index>(blocks.size()),
                                       static_cast<Eigen::Index>(columns));
  const auto whitened = all.rightCols(static_cast<Eigen::Index>(columns) - 1);
  return {static_cast<double>(blocks.size()), all.col(0).squaredNorm(), whitened.transpose() * all.col(0),
          whitened.transpose() * whitened, static_cast<Eigen::Index>(unknowns.scaled.size())};
}

/// The products of what common parts leave.
ChannelProducts subtract(ChannelProducts products, const Eigen::VectorXd& common) {
  const Eigen::VectorXd of_gram = products.gram * common;
  products.residual += common.dot(of_gram) - 2.0 * common.dot(products.projection);
  products.projection -= of_gram;
  return products;
}

/// Logarithm of the likelihood for one size of the unknown parts and one factor on the noise.
double calc_gaussian(const ChannelProducts& products, double scaled, double fixed, double noise) {
  Eigen::VectorXd sd = Eigen::VectorXd::Constant(products.projection.size(), fixed / noise);
  sd.head(products.scaled).setConstant(scaled / noise);
  sd[sd.size() - 1] = 1.0 / noise;
  Eigen::MatrixXd information = sd.asDiagonal() * products.gram * sd.asDiagonal();
  information.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(information);
  const Eigen::MatrixXd factor = cholesky.matrixL();
  const Eigen::VectorXd solved = cholesky.matrixL().solve(sd.cwiseProduct(products.projection));
  const double squares = (products.residual - solved.squaredNorm()) / (noise * noise);
  return 0.5 * products.count - 0.5 * squares - factor.diagonal().array().log().sum() -
         products.count * std::log(noise);
}

double add_logs(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log1p(std::exp(std::min(a, b) - larger));
}

double calc_student(double difference, double scale) {
  constexpr double kFreedom = 5.0;
  const double z = difference / scale;
  return -0.5 * (kFreedom + 1.0) * std::log1p(z * z / kFreedom);
}

double calc_mean(const Values& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double calc_median(Values values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mean height of a run against those of the others.
double judge_height(const MeasurementSet& set, std::size_t r, const MeasuredRun& run) {
  constexpr std::size_t kFewest = 3;
  constexpr double kLeast_m = 100.0;
  constexpr double kSdOfMedian = 1.4826;
  Values others_m;
  for (std::size_t other = 0; other < set.runs.size(); ++other) {
    if (other != r) others_m.push_back(calc_mean(set.runs[other].column(quantities::kElevation)));
  }
  if (others_m.size() < kFewest) return 0.0;
  const double middle_m = calc_median(others_m);
  for (double& height_m : others_m) height_m = std::abs(height_m - middle_m);
  const double scatter_m = std::max(kLeast_m, kSdOfMedian * calc_median(others_m));
  return calc_student(calc_mean(run.column(quantities::kElevation)) - middle_m, scatter_m);
}

/// Parts of a channel that fit runs best, the offset left out.
Eigen::VectorXd fit_kept(const std::vector<const ChannelProducts*>& runs, const std::vector<bool>& is_kept) {
  const Eigen::Index parts = runs.front()->projection.size();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(parts, parts);
  Eigen::VectorXd projection = Eigen::VectorXd::Zero(parts);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!is_kept[r]) continue;
    const double noise_squared = std::max(1.0, runs[r]->residual / runs[r]->count);
    gram += runs[r]->gram / noise_squared;
    projection += runs[r]->projection / noise_squared;
  }
  gram.row(parts - 1).setZero();
  gram.col(parts - 1).setZero();
  gram(parts - 1, parts - 1) = 1.0;
  projection[parts - 1] = 0.0;
  return gram.ldlt().solve(projection);
}

/// By how much the squares of a run, in those of its noise, are above what parts of its own leave.
double calc_run_excess(const ChannelProducts& run, const Eigen::VectorXd& common) {
  const Eigen::Index parts = run.projection.size();
  const Eigen::MatrixXd own = run.gram + Eigen::MatrixXd::Identity(parts, parts);
  const double least = run.residual - run.projection.dot(own.ldlt().solve(run.projection));
  return (subtract(run, common).residual - least) / std::max(1.0, least / run.count);
}

/// Parts that fit all runs but those that they do not describe.
Eigen::VectorXd fit_channel(const std::vector<const ChannelProducts*>& runs) {
  constexpr double kFew = 10.0;  // Assumed, as kOdd
  constexpr double kOdd = 3.0;   // times the excess of the middle run
  constexpr int kRounds = 4;
  std::vector<bool> is_kept(runs.size(), true);
  Eigen::VectorXd fitted = fit_kept(runs, is_kept);
  for (int round = 0; round < kRounds; ++round) {
    Values excess;
    for (const ChannelProducts* run : runs) excess.push_back(calc_run_excess(*run, fitted));
    const double usual = calc_median(excess);
    for (std::size_t r = 0; r < runs.size(); ++r) is_kept[r] = excess[r] <= kFew + kOdd * usual;
    fitted = fit_kept(runs, is_kept);
  }
  return fitted;
}

}  // namespace

ComparedRows choose_rows(const MeasurementSet& set, const MeasuredRun& run) {
  constexpr double kSlow = 0.2;  // Assumed: of the highest speed; about 20 km/h in town, in whatever unit
  const bool is_driven = models::is_of_vehicle(set.kind->traits);
  const Values& speed_m_s = run.column(quantities::kSpeed);
  const double slow_m_s = kSlow * *std::max_element(speed_m_s.begin(), speed_m_s.end());
  ComparedRows chosen;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    if (!run.has(channel)) continue;
    const bool is_force = channel == set.kind->traits.force;
    const Values& measured = run.column(channel);
    std::vector<std::size_t> samples;
    for (std::size_t row = 0; row < measured.size(); ++row) {
      const bool is_slow = is_driven && is_force && speed_m_s[row] < slow_m_s;
      if (!std::isnan(measured[row]) && !is_slow) samples.push_back(row);
    }
    std::vector<std::size_t> compared = find_compared_rows(set, run, channel);
    const bool all = is_driven || 2 * compared.size() < samples.size();
    chosen[channel] = all ? std::move(samples) : std::move(compared);
  }
  return chosen;
}

RunProducts calc_products(const MeasurementSet& set, const MeasuredRun& run, const sim::Recording<double>& simulated,
                          const ComparedRows& rows) {
  RunProducts products;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    products.emplace_back();
    if (!run.has(channel) || rows.count(channel) == 0) continue;
    std::vector<std::size_t> there;  // an exchanged column may have no samples in some of the rows
    for (const std::size_t row : rows.at(channel)) {
      if (!std::isnan(run.column(channel)[row])) there.push_back(row);
    }
    if (there.empty()) continue;
    const Values& expected = simulated.channel(channel);
    there = drop_spikes(run.column(channel), expected, set.sensors.at(channel).noise_sd, std::move(there));
    products.back() = calc_channel_products(set, run, channel, expected, there);
  }
  return products;
}

CommonParts fit_common(const std::vector<const RunProducts*>& runs) {
  constexpr std::size_t kFewestRuns = 3;
  CommonParts common;
  for (std::size_t c = 0; !runs.empty() && c < runs.front()->size(); ++c) {
    std::vector<const ChannelProducts*> with;
    for (const RunProducts* run : runs) {
      if ((*run)[c].has_value()) with.push_back(&*(*run)[c]);
    }
    if (with.size() < kFewestRuns) return {};
    common.push_back(fit_channel(with));
  }
  return common;
}

double calc_common_log_prior(const CommonParts& common, const RunProducts& products, double size) {
  double log = 0.0;
  for (std::size_t c = 0; c < common.size(); ++c) {
    if (!products[c].has_value()) continue;
    const Eigen::Index scaled = products[c]->scaled;
    log -= 0.5 * common[c].head(scaled).squaredNorm() / (size * size);
    log -= 0.5 * common[c].tail(common[c].size() - scaled).squaredNorm();
  }
  return log;
}

double calc_log_likelihood(const RunProducts& products, const CommonParts& common, double size) {
  constexpr double kShareOfRun = 0.5;  // of the size, where the runs have parts in common
  constexpr double kPower = 0.5;       // what B lacks goes through many samples, which are less independent for it
  double sum = 0.0;
  for (std::size_t c = 0; c < products.size(); ++c) {
    if (!products[c].has_value()) continue;
    const bool is_common = !common.empty();
    const ChannelProducts left = is_common ? subtract(*products[c], common[c]) : *products[c];
    const double share = is_common ? kShareOfRun : 1.0;
    double of_channel = -HUGE_VAL;
    for (const double noise : kNoiseFactors) {
      of_channel = add_logs(of_channel, calc_gaussian(left, share * size, 1.0, noise) - 2.0 * std::log(noise));
    }
    sum += kPower * of_channel;
  }
  return sum;
}

double calc_given_log_likelihood(const MeasurementSet& set, std::size_t r, const MeasuredRun& run) {
  constexpr double kUsual_K = 3.0;
  double sum = 0.0;
  const bool is_soaked = !run.started_warm && !run.rest_before_s.has_value();
  const double above_K = run.column(quantities::kAmbient).front() - run.initial_tire_temperature_K;
  if (is_soaked || above_K > 0.0) sum += calc_student(above_K, kUsual_K);
  if (run.has(quantities::kElevation)) sum += judge_height(set, r, run);
  return sum;
}

}  // namespace rollrig::diagnosis
