#include "diagnosis/next_test/predicted_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "diagnosis/checks/rig_sensors.h"
#include "measurements/sample_selection.h"
#include "measurements/whitener.h"

namespace rollrig::diagnosis {
namespace {

double find_first_interval_s(const PreparedSet& set) {
  return measurements::calc_mean_interval_s(set.runs().front().measured);
}

/// Drops the directions of a spread that noise hides.
RowMatrix compress(const RowMatrix& spread) {
  constexpr double kNegligible = 1e-3;  // of the noise's variance
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(spread.transpose() * spread);
  const Eigen::Index kept = (solver.eigenvalues().array() > kNegligible).count();
  return spread * solver.eigenvectors().rightCols(kept);
}

}  // namespace

measurements::MeasurementSet make_virtual_set(const PreparedSet& set, const PlannedTest& test) {
  measurements::MeasurementSet made = set.source();
  made.name = test.id;
  made.runs = test.runs;
  const double samples = std::max(1.0, kVirtualRow_s / find_first_interval_s(set));
  for (auto& [channel, sensor] : made.sensors) sensor = measurements::average_sensor(sensor, samples);
  for (const Quantity& channel : test.extra.sensors) made.sensors[channel] = find_rig_sensor(channel).error;
  return made;
}

RowMatrix make_offsets(const PreparedSet& set) {
  RowMatrix offsets = RowMatrix::Zero(to_index(set.residual_count()), to_index(set.offset_count()));
  for (const Series& series : set.series())
    series.rows_of(offsets).col(to_index(series.offset)).setConstant(series.offset_sd);
  return offsets;
}

PredictedTest::PredictedTest(const Study& study, const std::vector<OpenHypothesis>& open, const PlannedTest& test) {
  const PreparedSet set(make_virtual_set(study.set, test), test.extra);
  if (!simulate(set, study, open)) {
    predictions_.clear();
    return;
  }
  const Discrepancy discrepancy(set);
  const Amplitudes amplitudes = find_model_error(set);
  const auto whiten_fully = [&](auto& columns) {
    whiten(set, columns);
    discrepancy.whiten(amplitudes, columns);
  };
  offsets_ = make_offsets(set);
  whiten_fully(offsets_);
  for (Prediction& one : predictions_) {
    whiten_fully(one.mean);
    whiten_fully(one.spread);
  }
  for (const Series& series : set.series()) {
    channels_.insert(channels_.end(), series.size(), set.channels()[series.channel]);
  }
  if (test.clock_pulse) add_clock_reading(study, open);
  for (const NumberReading& number : test.numbers) add_number_reading(study, open, number);
}

bool PredictedTest::simulate(const PreparedSet& set, const Study& study, const std::vector<OpenHypothesis>& open) {
  for (const OpenHypothesis& one : open) {
    const Model model(set, study.base, one.hypothesis);
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
    unknowns.head(one.parameters.size()) = one.parameters;
    Prediction prediction;
    RowMatrix derivatives;
    if (!model.simulate(unknowns, 1, prediction.mean, &derivatives)) return false;
    prediction.spread = derivatives * one.spread;
    predictions_.push_back(std::move(prediction));
  }
  return true;
}

/// By channel: the baseline's, and a share of what the hypotheses differ by, in noise floors.
Amplitudes PredictedTest::find_model_error(const PreparedSet& set) const {
  const ModelError error;
  Amplitudes squares(set.channels().size(), 0.0);
  std::vector<double> counts(set.channels().size(), 0.0);
  for (const Series& series : set.series()) {
    for (const Prediction& one : predictions_) {
      const auto apart = (series.rows_of(one.mean) - series.rows_of(predictions_.front().mean)) / series.floor;
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

/// The difference of the clocks as the pulse shows it, appended: each logger knows it within its sampling interval.
void PredictedTest::add_clock_reading(const Study& study, const std::vector<OpenHypothesis>& open) {
  const double sd_s = find_first_interval_s(study.set) * std::sqrt(2.0 / 12.0);
  const Eigen::Index row = append_row();
  for (std::size_t h = 0; h < open.size(); ++h) {
    Prediction& prediction = predictions_[h];
    const Model model = study.make_model(open[h].hypothesis);
    for (std::size_t i = 0; i < model.own_count(); ++i) {
      const Model::OwnParameter& own = model.own_parameters()[i];
      if (!own.is_size() || own.term->name() != "clock_shift") continue;
      const PriorUnits shift_s = own.value_at(open[h].parameters[to_index(i)]);
      prediction.mean[row] = shift_s.value_SI / sd_s;
      prediction.spread.row(row) = shift_s.derivative_SI / sd_s * open[h].spread.row(to_index(i));
    }
  }
}

/// A number of the files as the test determines it, appended. Nothing where it is not among what may move.
void PredictedTest::add_number_reading(const Study& study, const std::vector<OpenHypothesis>& open,
                                       const NumberReading& number) {
  const auto is_it = [&](const estimation::FreeParameter& one) { return one.key == number.key; };
  const auto at = std::find_if(study.base.begin(), study.base.end(), is_it);
  if (at == study.base.end()) return;
  const Eigen::Index row = append_row();
  for (std::size_t h = 0; h < open.size(); ++h) {
    const Model model = study.make_model(open[h].hypothesis);
    const Eigen::Index base = to_index(model.own_count()) + (at - study.base.begin());
    const Eigen::RowVectorXd moves =
        model.moves_by_unknowns().row(base).head(open[h].parameters.size()) * at->prior_sd_SI / number.sd_SI;
    predictions_[h].mean[row] = moves.dot(open[h].parameters);
    predictions_[h].spread.row(row) = moves * open[h].spread;
  }
}

Eigen::Index PredictedTest::append_row() {
  const Eigen::Index row = offsets_.rows();
  for (Prediction& prediction : predictions_) {
    prediction.mean.conservativeResize(row + 1);
    prediction.spread.conservativeResize(row + 1, Eigen::NoChange);
    prediction.mean[row] = 0.0;
    prediction.spread.row(row).setZero();
  }
  channels_.emplace_back();
  offsets_.conservativeResize(row + 1, Eigen::NoChange);
  offsets_.bottomRows(1).setZero();
  return row;
}

/// Means and covariances in coordinates of few directions; in all others every outcome is the same noise.
std::vector<PredictedOutcome> PredictedTest::reduce(const std::vector<Prediction>& predictions,
                                                    const RowMatrix& common) {
  const Eigen::Index rows = common.rows();
  Eigen::Index count = common.cols() + to_index(predictions.size());
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

std::vector<PredictedOutcome> PredictedTest::find_outcomes(const std::function<bool(const Quantity&)>& wanted) const {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (wanted(channels_[i])) rows.push_back(to_index(i));
  }
  std::vector<Prediction> kept;
  for (const Prediction& one : predictions_) kept.push_back({one.mean(rows), compress(one.spread(rows, Eigen::all))});
  return reduce(kept, offsets_(rows, Eigen::all));
}

}  // namespace rollrig::diagnosis
