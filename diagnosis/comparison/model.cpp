#include "diagnosis/comparison/model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/checks/rig_sensors.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

void put_derivative(double&, double, std::size_t) {}
void put_derivative(Jet& jet, double derivative, std::size_t column) {
  if (column < static_cast<std::size_t>(kJetWidth)) jet.v[to_index(column)] = derivative;
}

template <class S>
S make_scalar(double value, double derivative, std::size_t column);
template <>
double make_scalar<double>(double value, double, std::size_t) {
  return value;
}
template <>
Jet make_scalar<Jet>(double value, double derivative, std::size_t column) {
  Jet jet(value);
  put_derivative(jet, derivative, column);
  return jet;
}

void store_derivatives(double, RowMatrix*, std::size_t, std::size_t, std::size_t) {}
void store_derivatives(const Jet& value, RowMatrix* out, std::size_t row, std::size_t first, std::size_t count) {
  for (std::size_t c = 0; c < count; ++c) (*out)(to_index(row), to_index(first + c)) = value.v[to_index(c)];
}

/// Beyond it a simulation has left its domain: the steps were too long for what moves that fast. Assumed: 2000 K,
/// 1 kbar, 100 kN or kN m.
double find_most_SI(const Quantity& channel) {
  const Dimension dimension = channel.file_unit().dimension;
  if (dimension == dimension::kTemperature) return 2000.0;
  return dimension == dimension::kPressure ? 1e8 : 1e5;
}

}  // namespace

Model::Model(const PreparedSet& set, std::vector<estimation::FreeParameter> base, Hypothesis hypothesis)
    : set_(set),
      base_(std::move(base)),
      prior_factor_(estimation::calc_prior_factor(base_)),
      hypothesis_(std::move(hypothesis)) {
  for (const estimation::FreeParameter& parameter : base_) base_keys_.push_back(read_machine_key(parameter.key));
  for (std::size_t t = 0; t < hypothesis_.terms.size(); ++t) {
    const auto& [term, sign] = hypothesis_.terms[t];
    for (std::size_t i = 0; i < term->parameters().size(); ++i) {
      own_.push_back({term, t, &term->parameters()[i], i, i == 0 ? sign : 1});
    }
  }
}

Eigen::MatrixXd Model::moves_by_unknowns() const {
  Eigen::MatrixXd moves = Eigen::MatrixXd::Identity(to_index(unknown_count()), to_index(unknown_count()));
  const Eigen::Index count = to_index(base_.size());
  moves.block(to_index(own_.size()), to_index(own_.size()), count, count) = prior_factor_;
  return moves;
}

bool Model::find_parameters(const Eigen::VectorXd& unknowns, std::vector<Parameter>& parameters) const {
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const PriorUnits value = own_[i].value_at(unknowns[to_index(i)]);
    if (!value.allowed) return false;
    parameters.push_back({value.value_SI, value.derivative_SI});
  }
  const Eigen::VectorXd moved = prior_factor_ * unknowns.segment(to_index(own_.size()), to_index(base_.size()));
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const double sd = base_[i].prior_sd_SI;
    parameters.push_back({base_[i].start_SI + sd * moved[to_index(i)], sd * prior_factor_(to_index(i), to_index(i))});
  }
  return true;
}

/// A base parameter with its derivatives by the unknowns of one pass.
template <class S>
S Model::make_base(std::size_t i, const std::vector<Parameter>& parameters, std::size_t first_column) const {
  const std::size_t own = own_.size();
  S base = make_scalar<S>(parameters[own + i].value_SI, parameters[own + i].derivative_SI, own + i - first_column);
  for (std::size_t j = 0; j < i; ++j) {
    put_derivative(base, base_[i].prior_sd_SI * prior_factor_(to_index(i), to_index(j)), own + j - first_column);
  }
  return base;
}

template <class S>
bool Model::simulate_run(std::size_t r, const std::vector<Parameter>& parameters, std::size_t first_column,
                         Eigen::VectorXd& values, RowMatrix* derivatives) const {
  const auto scalar = [&](std::size_t i) {
    return make_scalar<S>(parameters[i].value_SI, parameters[i].derivative_SI, i - first_column);
  };
  const PreparedRun& run = set_.runs()[r];
  models::Context<S> context = models::convert_context<S>(set_.context(run.machine));
  for (std::size_t i = 0; i < base_.size(); ++i) {
    if (!base_keys_[i].holds_on(run.machine)) continue;
    estimation::find_parameter(context, base_keys_[i].key) = make_base<S>(i, parameters, first_column);
  }
  std::vector<models::ActiveEffect> active;
  std::vector<std::optional<std::size_t>> places;  // of the terms among the active effects
  for (const SignedTerm& one : hypothesis_.terms) {
    places.emplace_back();
    if (!one.term->acts_on(run.machine)) continue;
    places.back() = active.size();
    active.push_back({&one.term->effect(), one.term->list_known(run)});
    active.back().parameters.resize(one.term->effect().info.parameters.size(), 0.0);
  }
  models::Corner<S> corner(std::move(context), active);
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const std::optional<std::size_t> place = places[own_[i].term_index];
    if (!place.has_value()) continue;
    corner.effects()[*place].parameters[own_[i].term->known_count() + own_[i].index] = scalar(i);
  }
  sim::Recording<S> recording;
  try {
    recording = run.resimulation.simulate(set_.source(run.machine), run.simulated.run, corner,
                                          set_.extra().sensors.empty() ? rigs::Detail::kMeasured : rigs::Detail::kFull);
  } catch (const RunFailure&) {
    return false;
  }
  const std::size_t count =
      std::min<std::size_t>(kJetWidth, parameters.size() - std::min(first_column, parameters.size()));
  for (const Series& series : set_.series()) {
    if (series.run != r) continue;
    const double most = find_most_SI(set_.channels()[series.channel]);
    const std::vector<S> simulated =
        read_channel(set_.source(run.machine), run.simulated.run, corner, recording, set_.channels()[series.channel]);
    for (std::size_t k = 0; k < series.size(); ++k) {
      const S mean = series.mean_of_simulated(k, simulated);
      if (!(std::abs(value_of(mean)) < most)) return false;  // NaN too
      if (first_column == 0) values[to_index(series.first_residual + k)] = value_of(mean);
      store_derivatives(mean, derivatives, series.first_residual + k, first_column, count);
    }
  }
  return true;
}

bool Model::simulate(const Eigen::VectorXd& unknowns, int threads, Eigen::VectorXd& values,
                     RowMatrix* derivatives) const {
  std::vector<Parameter> parameters;
  if (!find_parameters(unknowns, parameters)) return false;
  const std::size_t runs = set_.runs().size();
  const std::size_t passes = derivatives == nullptr ? 1 : (parameters.size() + kJetWidth - 1) / kJetWidth;
  values.setZero(to_index(residual_count()));
  if (derivatives != nullptr) derivatives->setZero(to_index(residual_count()), to_index(parameters.size()));
  std::vector<char> good(runs * passes, 1);
  parallel_for(runs * passes, threads, [&](std::size_t job) {
    const std::size_t run = job / passes;
    const std::size_t first = (job % passes) * kJetWidth;
    const bool done = derivatives == nullptr ? simulate_run<double>(run, parameters, 0, values, nullptr)
                                             : simulate_run<Jet>(run, parameters, first, values, derivatives);
    good[job] = done ? 1 : 0;
  });
  return std::find(good.begin(), good.end(), 0) == good.end();
}

bool Model::simulate_added(const Term& added, const Eigen::VectorXd& unknowns, Eigen::VectorXd& values) const {
  std::vector<Parameter> parameters;
  if (!find_parameters(unknowns, parameters)) return false;
  for (std::size_t run = 0; run < set_.runs().size(); ++run) {
    if (!added.acts_on(set_.runs()[run].machine)) continue;
    if (!simulate_run<double>(run, parameters, 0, values, nullptr)) return false;
  }
  return true;
}

bool Model::simulate_one(std::size_t run, const Eigen::VectorXd& unknowns, Eigen::VectorXd& values) const {
  std::vector<Parameter> parameters;
  values.setZero(to_index(residual_count()));
  return find_parameters(unknowns, parameters) && simulate_run<double>(run, parameters, 0, values, nullptr);
}

bool Model::derive_run(std::size_t run, const Eigen::VectorXd& unknowns, RowMatrix& derivatives) const {
  std::vector<Parameter> parameters;
  Eigen::VectorXd values(to_index(residual_count()));
  return find_parameters(unknowns, parameters) && simulate_run<Jet>(run, parameters, 0, values, &derivatives);
}

Eigen::VectorXd Model::subtract_from_measured(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& simulated) const {
  Eigen::VectorXd difference = set_.measured() - simulated;
  for (const Series& series : set_.series()) {
    series.rows_of(difference).array() -= series.offset_sd * unknowns[to_index(parameter_count() + series.offset)];
  }
  return difference;
}

bool Model::evaluate(const Eigen::VectorXd& unknowns, int threads, Eigen::VectorXd& residuals,
                     RowMatrix* jacobian) const {
  Eigen::VectorXd simulated;
  RowMatrix derivatives;
  if (!simulate(unknowns, threads, simulated, jacobian != nullptr ? &derivatives : nullptr)) return false;
  residuals = subtract_from_measured(unknowns, simulated);
  if (jacobian != nullptr) {
    jacobian->setZero(to_index(residual_count()), to_index(unknown_count()));
    jacobian->leftCols(to_index(parameter_count())) = -derivatives;
    for (const Series& series : set_.series()) {
      series.rows_of(*jacobian).col(to_index(parameter_count() + series.offset)).setConstant(-series.offset_sd);
    }
  }
  whiten(set_, residuals);
  if (jacobian != nullptr) whiten(set_, *jacobian);
  return true;
}

void whiten(const PreparedSet& set, RowMatrix& columns) {
  for (const Series& series : set.series()) {
    series.whitener.apply(columns.row(to_index(series.first_residual)).data(),
                          static_cast<std::size_t>(columns.cols()));
  }
}

void whiten(const PreparedSet& set, Eigen::VectorXd& column) {
  for (const Series& series : set.series()) series.whitener.apply(column.data() + series.first_residual, 1);
}

}  // namespace rollrig::diagnosis
