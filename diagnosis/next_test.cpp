#include "diagnosis/next_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "diagnosis/verdict.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

/// Means over ten seconds come as one sample a row: of a sensor whose noise they lessen, and whose rounding.
models::SensorParameters average_sensor(models::SensorParameters sensor, double samples) {
  const double lasting = identification::calc_lasting_rounding_variance(sensor.resolution, sensor.noise_sd);
  const double white = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0 - lasting;
  sensor.noise_sd = std::sqrt(white / samples + lasting);
  sensor.resolution = 0.0;
  return sensor;
}

double find_sample_interval_s(const PreparedSet& set) {
  const std::vector<double>& time_s = set.runs().front().measured.time_s;
  return (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
}

/// The test's runs as a set on the same rig, with the same sensors.
scenarios::MeasurementSet make_virtual_set(const PreparedSet& set, const PlannedTest& test) {
  scenarios::MeasurementSet made;
  made.path = set.source().path;
  made.name = test.id;
  made.kind = set.source().kind;
  made.baseline = set.source().baseline;
  made.tire = set.source().tire;
  made.rig = set.source().rig;
  made.vehicle = set.source().vehicle;
  made.runs = test.runs;
  const double samples = std::max(1.0, kVirtualRow_s / find_sample_interval_s(set));
  for (const auto& [channel, sensor] : set.source().sensors) made.sensors[channel] = average_sensor(sensor, samples);
  // Assumed: thermocouple good for 0.1 K; hub bearings and radiation keep a rim that takes no heat within 2 K of the
  // air.
  if (test.extra.rim_thermocouple) made.sensors[kRimTemperature] = {2.0, 0.05, 60.0, 0.1, 0.0};
  return made;
}

/// One hypothesis on a test: whitened block means and how they move with its parameters' spread.
struct Prediction {
  Eigen::VectorXd mean;
  RowMatrix spread;
};

/// Drops the directions of a spread that noise hides.
RowMatrix compress(const RowMatrix& spread) {
  constexpr double kNegligible = 1e-3;  // of the noise's variance
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(spread.transpose() * spread);
  const Eigen::Index kept = (solver.eigenvalues().array() > kNegligible).count();
  return spread * solver.eigenvectors().rightCols(kept);
}

/// The clocks' difference as the pulse shows it, appended: each logger knows it within its sampling interval.
void add_clock_reading(const Model& model, const OpenHypothesis& open, double interval_s, Prediction& prediction) {
  const double sd_s = interval_s * std::sqrt(2.0 / 12.0);
  const Eigen::Index row = prediction.mean.size();
  prediction.mean.conservativeResize(row + 1);
  prediction.spread.conservativeResize(row + 1, Eigen::NoChange);
  prediction.mean[row] = 0.0;
  prediction.spread.row(row).setZero();
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const Model::OwnParameter& own = model.own_parameters()[i];
    if (own.index != 0 || model.hypothesis().effects[own.effect].effect->info.id != "clock_shift") continue;
    const PriorUnits shift_s = model.own_value(i, open.parameters[at(i)]);
    prediction.mean[row] = shift_s.value_SI / sd_s;
    prediction.spread.row(row) = shift_s.derivative_SI / sd_s * open.spread.row(at(i));
  }
}

/// Columns of the new session's sensor offsets.
RowMatrix make_offsets(const PreparedSet& virtual_set) {
  RowMatrix offsets = RowMatrix::Zero(at(virtual_set.residual_count()), at(virtual_set.offset_count()));
  for (const Series& series : virtual_set.series()) {
    offsets.block(at(series.first_residual), at(series.offset), at(series.size()), 1).setConstant(series.offset_sd);
  }
  return offsets;
}

/// Model error by channel: the baseline's, and a share of what the hypotheses differ by, in noise floors.
Amplitudes find_model_error(const PreparedSet& virtual_set, const std::vector<Prediction>& predictions) {
  const ModelError error;
  Amplitudes squares(virtual_set.channels().size(), 0.0);
  std::vector<double> counts(virtual_set.channels().size(), 0.0);
  for (const Series& series : virtual_set.series()) {
    for (const Prediction& one : predictions) {
      const auto apart =
          (one.mean - predictions.front().mean).segment(at(series.first_residual), at(series.size())) / series.floor;
      squares[series.channel] += apart.squaredNorm();
      counts[series.channel] += static_cast<double>(series.size());
    }
  }
  Amplitudes amplitudes;
  for (std::size_t c = 0; c < squares.size(); ++c) {
    const double apart = counts[c] > 0.0 ? std::sqrt(squares[c] / counts[c]) : 0.0;
    amplitudes.push_back(std::hypot(error.baseline_floors, error.law_share * apart));
  }
  return amplitudes;
}

/// Means and covariances in coordinates of few directions; in all others every outcome is the same noise.
std::vector<PredictedOutcome> reduce(const std::vector<Prediction>& predictions, const RowMatrix& common) {
  const Eigen::Index rows = common.rows();
  Eigen::Index count = common.cols() + at(predictions.size());
  for (const Prediction& one : predictions) count += one.spread.cols();
  RowMatrix all(rows, count);
  all.leftCols(common.cols()) = common;
  Eigen::Index column = common.cols();
  for (const Prediction& one : predictions) {
    all.col(column++) = one.mean - predictions.front().mean;
    all.middleCols(column, one.spread.cols()) = one.spread;
    column += one.spread.cols();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(all.transpose() * all);
  constexpr double kNegligible = 1e-12;
  const double largest = solver.eigenvalues()[count - 1];
  const Eigen::Index kept = (solver.eigenvalues().array() > kNegligible * largest).count();
  const Eigen::MatrixXd reduced =
      solver.eigenvalues().tail(kept).cwiseSqrt().asDiagonal() * solver.eigenvectors().rightCols(kept).transpose();
  const auto offsets = reduced.leftCols(common.cols());
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(kept, kept) + offsets * offsets.transpose();
  std::vector<PredictedOutcome> outcomes;
  column = common.cols();
  for (const Prediction& one : predictions) {
    const Eigen::VectorXd mean = reduced.col(column++);
    const auto spread = reduced.middleCols(column, one.spread.cols());
    outcomes.push_back({mean, noise + spread * spread.transpose()});
    column += one.spread.cols();
  }
  return outcomes;
}

}  // namespace

std::vector<PredictedOutcome> predict_outcomes(const PreparedSet& set,
                                               const std::vector<identification::FreeParameter>& base,
                                               const std::vector<OpenHypothesis>& open, const PlannedTest& test) {
  const PreparedSet virtual_set(make_virtual_set(set, test), test.extra);
  std::vector<Prediction> predictions;
  for (const OpenHypothesis& one : open) {
    const Model model(virtual_set, base, one.hypothesis);
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(at(model.unknown_count()));
    unknowns.head(one.parameters.size()) = one.parameters;
    Prediction prediction;
    RowMatrix derivatives;
    if (!model.simulate(unknowns, 1, prediction.mean, &derivatives)) return {};
    prediction.spread = derivatives * one.spread;
    predictions.push_back(std::move(prediction));
  }
  const Remainder remainder(virtual_set);
  const Amplitudes amplitudes = find_model_error(virtual_set, predictions);
  RowMatrix offsets = make_offsets(virtual_set);
  const auto whiten_fully = [&](auto& columns) {
    whiten(virtual_set, columns);
    remainder.whiten(amplitudes, columns);
  };
  whiten_fully(offsets);
  for (std::size_t i = 0; i < open.size(); ++i) {
    whiten_fully(predictions[i].mean);
    whiten_fully(predictions[i].spread);
    if (test.clock_pulse) {
      const Model model(virtual_set, base, open[i].hypothesis);
      add_clock_reading(model, open[i], find_sample_interval_s(set), predictions[i]);
    }
    predictions[i].spread = compress(predictions[i].spread);
  }
  if (test.clock_pulse) {
    offsets.conservativeResize(offsets.rows() + 1, Eigen::NoChange);
    offsets.bottomRows(1).setZero();
  }
  return reduce(predictions, offsets);
}

namespace {

/// Whether two predictions overlap as little as two of equal covariance whose expected log Bayes factor is 3: their
/// distance of Bhattacharyya is a quarter of it. Unlike the divergence it does not depend on which is true.
bool are_told_apart(const PredictedOutcome& a, const PredictedOutcome& b) {
  return 4.0 * calc_overlap_distance_nats(a, b) >= kToldApart_nats;
}

/// Effects in one hypothesis of a pair and not in the other, of all pairs of a likeliest hypothesis and any other that
/// are told apart.
void find_splits(const std::vector<OpenHypothesis>& open, const std::vector<PredictedOutcome>& outcomes,
                 JudgedTest& judged) {
  const auto add = [&](const Hypothesis& in, const Hypothesis& not_in) {
    for (const ActingEffect& on : in.effects) {
      const std::string& id = on.effect->info.id;
      const bool known = std::find(judged.splits.begin(), judged.splits.end(), id) != judged.splits.end();
      if (!known && !not_in.contains(*on.effect)) judged.splits.push_back(id);
    }
  };
  const auto is_likeliest = [&](std::size_t i) { return open[i].probability >= open.front().probability; };
  for (std::size_t i = 0; i < open.size() && is_likeliest(i); ++i) {
    for (std::size_t j = i + 1; j < open.size(); ++j) {
      if (!are_told_apart(outcomes[i], outcomes[j])) continue;
      add(open[i].hypothesis, open[j].hypothesis);
      add(open[j].hypothesis, open[i].hypothesis);
      judged.splits_likeliest = judged.splits_likeliest || is_likeliest(j);
    }
  }
}

}  // namespace

std::vector<JudgedTest> judge_tests(const PreparedSet& set, const std::vector<identification::FreeParameter>& base,
                                    const std::vector<OpenHypothesis>& open, int threads) {
  std::vector<JudgedTest> judged;
  for (PlannedTest& test : make_test_menu(set)) judged.push_back({std::move(test), 0.0, {}, false});
  std::vector<double> probabilities;
  for (const OpenHypothesis& one : open) probabilities.push_back(one.probability);
  parallel_for(judged.size(), threads, [&](std::size_t i) {
    const std::vector<PredictedOutcome> outcomes = predict_outcomes(set, base, open, judged[i].test);
    if (outcomes.empty()) return;
    judged[i].bits = calc_information_bits(probabilities, outcomes);
    find_splits(open, outcomes, judged[i]);
  });
  return judged;
}

std::vector<NextTest> propose_tests(const PreparedSet& set, const std::vector<identification::FreeParameter>& base,
                                    const Remainder& remainder, const Race& race, int threads) {
  constexpr std::size_t kProposed = 3;
  constexpr double kWorthwhile_bits = 0.01;
  const std::vector<OpenHypothesis> open = find_open_hypotheses(set, base, remainder, race, threads);
  if (open.size() < 2) return {};
  std::vector<JudgedTest> judged = judge_tests(set, base, open, threads);
  std::stable_sort(judged.begin(), judged.end(), [](const JudgedTest& a, const JudgedTest& b) {
    if (a.splits_likeliest != b.splits_likeliest) return a.splits_likeliest;
    return a.bits / a.test.hours > b.bits / b.test.hours;
  });
  std::vector<NextTest> proposed;
  for (const JudgedTest& one : judged) {
    if (proposed.size() == kProposed) break;
    if (one.bits >= kWorthwhile_bits) proposed.push_back({one.test.description, one.splits, one.bits / one.test.hours});
  }
  return proposed;
}

}  // namespace rollrig::diagnosis
