#include "diagnosis/campaign/test_information.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/next_test/predicted_test.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

/// Adds what a test tells by readings that determine a base parameter directly, such as a mass on a scale: the product
/// of the reading's derivatives by the base parameters, over its standard deviation.
void add_numbers(const Study& study, const Model& model, const PlannedTest& test, TestInformation& information) {
  const Eigen::MatrixXd moves = model.moves_by_unknowns();
  const auto count = to_index(study.base.size());
  for (const NumberReading& number : test.numbers) {
    for (std::size_t i = 0; i < study.base.size(); ++i) {
      if (study.base[i].key != number.key) continue;
      const Eigen::VectorXd row =
          moves.row(to_index(i)).head(count).transpose() * (study.base[i].prior_sd_SI / number.sd_SI);
      information.base += row * row.transpose();
    }
  }
}

/// Changes of the block means by each size, in SI units; 0 if a size cannot be simulated.
RowMatrix find_changes(const PreparedSet& set, const Study& study, const std::vector<JudgedSize>& sizes,
                       const Eigen::VectorXd& without) {
  RowMatrix changes = RowMatrix::Zero(without.size(), to_index(sizes.size()));
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Model model(set, study.base, Hypothesis{}.with(sizes[i].term));
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
    unknowns[0] = sizes[i].u;
    Eigen::VectorXd with;
    if (model.simulate(unknowns, 1, with, nullptr)) changes.col(to_index(i)) = with - without;
  }
  return changes;
}

}  // namespace

std::vector<JudgedSize> list_judged_sizes(const Term& term) {
  constexpr double kNear = 0.25;  // of the prior's interval, as in the screening
  const models::EffectParameter& size = term.parameters().front();
  if (size.prior.either_sign) return {{{&term, 1}, 0.0}, {{&term, -1}, 0.0}};
  const bool does_nothing =
      size.prior.scale == models::Prior::Scale::kLinear &&
      std::abs(size.prior.center() - size.off.value_or(0.0)) < kNear * (size.prior.high - size.prior.low);
  if (does_nothing) return {{{&term, 1}, 1.0}, {{&term, 1}, -1.0}};
  return {{{&term, 1}, 0.0}};
}

TestInformation& TestInformation::operator+=(const TestInformation& other) {
  base += other.base;
  through += other.through;
  squares += other.squares;
  return *this;
}

Eigen::VectorXd TestInformation::calc_detectability() const {
  const Eigen::LLT<Eigen::MatrixXd> factor(base + Eigen::MatrixXd::Identity(base.rows(), base.cols()));
  const Eigen::MatrixXd taken = factor.solve(through);
  Eigen::VectorXd detectability(squares.size());
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    detectability[i] = std::sqrt(std::max(0.0, squares[i] - through.col(i).dot(taken.col(i))));
  }
  return detectability;
}

TestInformation make_no_information(const Study& study, const std::vector<JudgedSize>& sizes) {
  const Eigen::Index numbers = to_index(study.base.size());
  const Eigen::Index effects = to_index(sizes.size());
  return {Eigen::MatrixXd::Zero(numbers, numbers), Eigen::MatrixXd::Zero(numbers, effects),
          Eigen::VectorXd::Zero(effects)};
}

std::optional<TestInformation> predict_information(const Study& study, const std::vector<JudgedSize>& sizes,
                                                   const PlannedTest& test) {
  const PreparedSet set(make_virtual_set(study.set, test), test.extra);
  const Model model(set, study.base, {});
  Eigen::VectorXd without;
  RowMatrix by_numbers;
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
  if (!model.simulate(middle, 1, without, &by_numbers)) return std::nullopt;
  RowMatrix changes = find_changes(set, study, sizes, without);
  RowMatrix offsets = make_offsets(set);
  const Discrepancy discrepancy(set);
  const Amplitudes amplitudes(set.channels().size(), ModelError{}.baseline_floors);
  for (RowMatrix* columns : {&by_numbers, &changes, &offsets}) {
    whiten(set, *columns);
    discrepancy.whiten(amplitudes, *columns);
  }
  const Eigen::Index count = offsets.cols();
  const Eigen::LLT<Eigen::MatrixXd> factor(offsets.transpose() * offsets + Eigen::MatrixXd::Identity(count, count));
  const auto average_over_offsets = [&](const RowMatrix& columns) -> RowMatrix {
    return columns - offsets * factor.solve(offsets.transpose() * columns);
  };
  const RowMatrix left = average_over_offsets(changes);
  TestInformation information{by_numbers.transpose() * average_over_offsets(by_numbers), by_numbers.transpose() * left,
                              (changes.array() * left.array()).colwise().sum().matrix().transpose()};
  add_numbers(study, model, test, information);
  return information;
}

}  // namespace rollrig::diagnosis
