#include "fmu/fastest_rate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace rollrig::fmu {
namespace {

/// What holds at a moment, without slopes.
sim::Segment make_moment(const WheelModel& model, double speed_m_s) {
  sim::Segment moment;
  for (const double input : {speed_m_s, model.load_N, model.ambient_K, model.ambient_K, 0.0}) {
    moment.inputs.push_back({input, 0.0});
  }
  return moment;
}

}  // namespace

double FastestRate::calc_per_s(const sim::Segment& inputs, double acceleration_m_s2, const double* states) {
  const auto count = static_cast<Eigen::Index>(equations_.states.size());
  Eigen::MatrixXd jacobian(count, count);
  equations_.wheel.set_given({Jet(acceleration_m_s2), {}});
  for (Eigen::Index first = 0; first < count; first += kJetWidth) {
    const Eigen::Index end = std::min<Eigen::Index>(first + kJetWidth, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      Jet& state = equations_.states[static_cast<std::size_t>(i)];
      state = Jet(states[i]);
      if (i >= first && i < end) state.v[i - first] = 1.0;
    }
    equations_.evaluate(inputs, 0.0);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Jet& rate = equations_.rates[static_cast<std::size_t>(i)];
      jacobian.row(i).segment(first, end - first) = rate.v.head(end - first).transpose();
    }
  }
  return jacobian.eigenvalues().cwiseAbs().maxCoeff();
}

FastestRate::FastestRate(const WheelModel& model) : equations_(model) {
  for (const double speed_m_s : {0.0, kHighestSpeed_m_s}) {
    const sim::Segment moment = make_moment(model, speed_m_s);
    equations_.wheel.initialize(moment, 0.0, equations_.states.data());
    std::vector<double> states;
    for (const Jet& state : equations_.states) states.push_back(state.a);
    usual_per_s_ = std::max(usual_per_s_, calc_per_s(moment, 0.0, states.data()));
  }
}

Culprit find_culprit(const WheelModel& model, const WheelModel& original) {
  constexpr double kSmall = 1e-3;  // share of a value, for the slope of a logarithm
  std::vector<double> former;
  WheelModel::visit_used(original, [&](const std::string&, const Field&, double value) { former.push_back(value); });
  const double rate_per_s = FastestRate(model).usual_per_s();
  WheelModel changed = model;
  std::vector<Culprit> found;
  std::vector<bool> is_set;
  WheelModel::visit_used(changed, [&](const std::string& name, const Field& field, double& value) {
    const double given = value;
    value *= 1.0 + kSmall;
    const double exponent = std::log(FastestRate(changed).usual_per_s() / rate_per_s) / std::log1p(kSmall);
    value = given;
    is_set.push_back(given != former[found.size()]);
    found.push_back({name, field, given, std::isfinite(exponent) ? exponent : 0.0});
  });
  const auto rank = [&](std::size_t i) {
    return std::pair(is_set[i] && std::abs(found[i].exponent) > 0.1, std::abs(found[i].exponent));
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < found.size(); ++i) best = rank(i) > rank(best) ? i : best;
  return found[best];
}

}  // namespace rollrig::fmu
