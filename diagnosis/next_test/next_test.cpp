#include "diagnosis/next_test/next_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/findings/verdict.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

/// Means over ten seconds come as one sample a row: of a sensor whose noise they lessen, and whose rounding.
models::SensorParameters average_sensor(models::SensorParameters sensor, double samples) {
  const double lasting = measurements::calc_lasting_rounding_variance(sensor.resolution, sensor.noise_sd);
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
measurements::MeasurementSet make_virtual_set(const PreparedSet& set, const PlannedTest& test) {
  measurements::MeasurementSet made;
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
  for (const std::string& channel : test.extra.sensors) made.sensors[channel] = find_rig_sensor(channel).error;
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

/// All hypotheses on a test, whitened: a row for each block mean, the clocks' difference last.
struct Whitened {
  std::vector<Prediction> predictions;  // empty where one cannot be simulated
  RowMatrix offsets;
  std::vector<std::string> channels;  // of each row; empty for the clocks
};

Whitened predict(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                 const std::vector<OpenHypothesis>& open, const PlannedTest& test) {
  const PreparedSet virtual_set(make_virtual_set(set, test), test.extra);
  Whitened whitened;
  for (const OpenHypothesis& one : open) {
    const Model model(virtual_set, base, one.hypothesis);
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(at(model.unknown_count()));
    unknowns.head(one.parameters.size()) = one.parameters;
    Prediction prediction;
    RowMatrix derivatives;
    if (!model.simulate(unknowns, 1, prediction.mean, &derivatives)) return {};
    prediction.spread = derivatives * one.spread;
    whitened.predictions.push_back(std::move(prediction));
  }
  const Discrepancy discrepancy(virtual_set);
  const Amplitudes amplitudes = find_model_error(virtual_set, whitened.predictions);
  whitened.offsets = make_offsets(virtual_set);
  const auto whiten_fully = [&](auto& columns) {
    whiten(virtual_set, columns);
    discrepancy.whiten(amplitudes, columns);
  };
  whiten_fully(whitened.offsets);
  for (const Series& series : virtual_set.series()) {
    whitened.channels.insert(whitened.channels.end(), series.size(), virtual_set.channels()[series.channel]);
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    whiten_fully(whitened.predictions[i].mean);
    whiten_fully(whitened.predictions[i].spread);
    if (test.clock_pulse) {
      const Model model(virtual_set, base, open[i].hypothesis);
      add_clock_reading(model, open[i], find_sample_interval_s(set), whitened.predictions[i]);
    }
  }
  if (test.clock_pulse) {
    whitened.channels.emplace_back();
    whitened.offsets.conservativeResize(whitened.offsets.rows() + 1, Eigen::NoChange);
    whitened.offsets.bottomRows(1).setZero();
  }
  return whitened;
}

/// Outcomes as far as the channels of `wanted` show them. Noise and model error of a channel do not depend on another,
/// so that whitened rows may be left out.
std::vector<PredictedOutcome> find_outcomes(const Whitened& whitened,
                                            const std::function<bool(const std::string&)>& wanted) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < whitened.channels.size(); ++i) {
    if (wanted(whitened.channels[i])) rows.push_back(at(i));
  }
  std::vector<Prediction> predictions;
  for (const Prediction& one : whitened.predictions) {
    Prediction kept{Eigen::VectorXd(at(rows.size())), RowMatrix(at(rows.size()), one.spread.cols())};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      kept.mean[at(i)] = one.mean[rows[i]];
      kept.spread.row(at(i)) = one.spread.row(rows[i]);
    }
    kept.spread = compress(kept.spread);
    predictions.push_back(std::move(kept));
  }
  RowMatrix offsets(at(rows.size()), whitened.offsets.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) offsets.row(at(i)) = whitened.offsets.row(rows[i]);
  return reduce(predictions, offsets);
}

}  // namespace

std::vector<PredictedOutcome> predict_outcomes(const PreparedSet& set,
                                               const std::vector<estimation::FreeParameter>& base,
                                               const std::vector<OpenHypothesis>& open, const PlannedTest& test) {
  const Whitened whitened = predict(set, base, open, test);
  if (whitened.predictions.empty()) return {};
  return find_outcomes(whitened, [](const std::string&) { return true; });
}

namespace {

/// Whether two predictions overlap as little as two of equal covariance whose expected log Bayes factor is 3: their
/// distance of Bhattacharyya is a quarter of it. Unlike the divergence it does not depend on which is true.
bool are_told_apart(const PredictedOutcome& a, const PredictedOutcome& b) {
  return 4.0 * calc_overlap_distance_nats(a, b) >= thresholds::kToldApart_nats;
}

/// What a test splits.
struct Splits {
  std::vector<std::string> effects;
  bool likeliest = false;  // tells two of the likeliest hypotheses apart
};

/// Effects in one hypothesis of a pair and not in the other, of all pairs of a likeliest hypothesis and any other that
/// are told apart.
Splits find_splits(const std::vector<OpenHypothesis>& open,
                   const std::function<bool(std::size_t, std::size_t)>& are_apart) {
  Splits splits;
  const auto add = [&](const Hypothesis& in, const Hypothesis& not_in) {
    for (const ActingEffect& on : in.effects) {
      const std::string& id = on.effect->info.id;
      const bool known = std::find(splits.effects.begin(), splits.effects.end(), id) != splits.effects.end();
      if (!known && !not_in.contains(*on.effect)) splits.effects.push_back(id);
    }
  };
  const auto is_likeliest = [&](std::size_t i) { return open[i].probability >= open.front().probability; };
  for (std::size_t i = 0; i < open.size() && is_likeliest(i); ++i) {
    for (std::size_t j = i + 1; j < open.size(); ++j) {
      if (!are_apart(i, j)) continue;
      add(open[i].hypothesis, open[j].hypothesis);
      add(open[j].hypothesis, open[i].hypothesis);
      splits.likeliest = splits.likeliest || is_likeliest(j);
    }
  }
  return splits;
}

std::vector<double> list_probabilities(const std::vector<OpenHypothesis>& open) {
  std::vector<double> probabilities;
  for (const OpenHypothesis& one : open) probabilities.push_back(one.probability);
  return probabilities;
}

constexpr double kWorthwhile_bits = 0.01;

}  // namespace

std::vector<JudgedTest> judge_tests(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                    const std::vector<OpenHypothesis>& open, int threads) {
  std::vector<JudgedTest> judged;
  for (PlannedTest& test : make_test_menu(set)) judged.push_back({std::move(test), 0.0, {}, false});
  const std::vector<double> probabilities = list_probabilities(open);
  parallel_for(judged.size(), threads, [&](std::size_t i) {
    const std::vector<PredictedOutcome> outcomes = predict_outcomes(set, base, open, judged[i].test);
    if (outcomes.empty()) return;
    judged[i].bits = calc_information_bits(probabilities, outcomes);
    const Splits splits =
        find_splits(open, [&](std::size_t a, std::size_t b) { return are_told_apart(outcomes[a], outcomes[b]); });
    judged[i].splits = splits.effects;
    judged[i].splits_likeliest = splits.likeliest;
  });
  return judged;
}

std::vector<NextTest> propose_tests(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                    const std::vector<OpenHypothesis>& open, int threads) {
  constexpr std::size_t kProposed = 3;
  if (open.size() < 2) return {};
  std::vector<JudgedTest> judged = judge_tests(set, base, open, threads);
  std::stable_sort(judged.begin(), judged.end(), [](const JudgedTest& a, const JudgedTest& b) {
    if (a.splits_likeliest != b.splits_likeliest) return a.splits_likeliest;
    return a.bits / a.test.hours > b.bits / b.test.hours;
  });
  std::vector<NextTest> proposed;
  for (const JudgedTest& one : judged) {
    if (proposed.size() == kProposed) break;
    if (one.bits < kWorthwhile_bits) continue;
    proposed.push_back({one.test.description, one.splits, one.bits / one.test.hours, one.test.hours, one.test.soaked,
                        one.test.extra.force_at_standstill, one.test.by_hand, one.test.runs});
  }
  return proposed;
}

std::vector<NextSensor> propose_sensors(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                        const std::vector<OpenHypothesis>& open) {
  const std::optional<PlannedTest> run = open.size() < 2 ? std::nullopt : set.kind().make_sensor_test(set);
  if (!run.has_value()) return {};
  const Whitened whitened = predict(set, base, open, *run);
  if (whitened.predictions.empty()) return {};
  const std::vector<std::string>& added = run->extra.sensors;
  const auto is_added = [&](const std::string& channel) {
    return std::find(added.begin(), added.end(), channel) != added.end();
  };
  const std::vector<double> probabilities = list_probabilities(open);
  const std::vector<PredictedOutcome> without =
      find_outcomes(whitened, [&](const std::string& channel) { return !is_added(channel); });
  const double bits_without = calc_information_bits(probabilities, without);
  std::vector<NextSensor> proposed;
  for (const std::string& sensor : added) {
    const std::vector<PredictedOutcome> with =
        find_outcomes(whitened, [&](const std::string& channel) { return channel == sensor || !is_added(channel); });
    const double bits = calc_information_bits(probabilities, with) - bits_without;
    if (bits < kWorthwhile_bits) continue;
    const Splits splits = find_splits(open, [&](std::size_t a, std::size_t b) {
      return are_told_apart(with[a], with[b]) && !are_told_apart(without[a], without[b]);
    });
    const RigSensor& named = find_rig_sensor(sensor);
    proposed.push_back({named.description, splits.effects, bits, named.hours});
  }
  std::stable_sort(proposed.begin(), proposed.end(), [](const NextSensor& a, const NextSensor& b) {
    return a.expected_bits / a.hours > b.expected_bits / b.hours;
  });
  return proposed;
}

}  // namespace rollrig::diagnosis
