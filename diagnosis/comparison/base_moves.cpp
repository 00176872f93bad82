#include "diagnosis/comparison/base_moves.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

std::vector<std::size_t> sort_by_move(const Eigen::VectorXd& moves) {
  std::vector<std::size_t> order(static_cast<std::size_t>(moves.size()));
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&moves](std::size_t a, std::size_t b) {
    return std::abs(moves[to_index(a)]) > std::abs(moves[to_index(b)]);
  });
  return order;
}

}  // namespace

Eigen::VectorXd calc_base_moves(const Study& study, const Fit& fit) {
  const Model model = study.make_model(fit.hypothesis);
  const Eigen::VectorXd moves = model.moves_by_unknowns() * fit.unknowns;
  return moves.segment(to_index(model.own_count()), to_index(study.base.size()));
}

std::vector<rollrig::BaseNumber> list_base_numbers(const Study& study, const Candidate* cause) {
  const Eigen::VectorXd moves = calc_base_moves(study, study.null.fit);
  const Eigen::VectorXd with_cause = cause != nullptr ? calc_base_moves(study, cause->fit) : moves;
  std::vector<rollrig::BaseNumber> numbers;
  for (const std::size_t i : sort_by_move(with_cause)) {
    const estimation::FreeParameter& base = study.base[i];
    rollrig::BaseNumber number;
    number.name = estimation::find_file_key(base.key);
    const Unit unit = unit_of_key(last_part(number.name));
    const auto value_at = [&](double move) { return unit.from_si(base.start_SI + move * base.prior_sd_SI); };
    number.unit = unit.symbol;
    number.value = value_at(0.0);
    number.sd = base.prior_sd_SI / unit.factor;
    number.sd_source = study.sd_sources.at(base.key);
    number.moved_sd = moves[to_index(i)];
    number.recalibrated = value_at(number.moved_sd);
    if (cause != nullptr) {
      number.with_cause_moved_sd = with_cause[to_index(i)];
      number.with_cause = value_at(*number.with_cause_moved_sd);
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

std::string describe_far_moves(const Study& study, const Fit& fit) {
  if (study.base.empty()) return {};
  const double tail = thresholds::kFarMoveChance / (2.0 * static_cast<double>(study.base.size()));
  const double far_sd = boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
  const Eigen::VectorXd moves = calc_base_moves(study, fit);
  std::vector<std::string> far;
  for (const std::size_t i : sort_by_move(moves)) {
    const double move = moves[to_index(i)];
    if (std::abs(move) <= far_sd) break;
    const std::string name = estimation::find_file_key(study.base[i].key);
    far.push_back(fmt::format("{} by {:+.1f}", name, move));
  }
  if (far.empty()) return {};
  return fmt::format("{} of {} standard uncertainties", fmt::join(far, ", "), far.size() == 1 ? "its" : "their");
}

}  // namespace rollrig::diagnosis
