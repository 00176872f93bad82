#include "diagnosis/comparison/law_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rollrig::diagnosis {
namespace {

constexpr Eigen::Index kLawForms = 6;

/// The fit's unknowns without those of one term, for `without`.
Eigen::VectorXd leave_out_own(const Model& with, const Model& without, const Fit& fit, const Term& term) {
  Eigen::VectorXd unknowns(to_index(without.unknown_count()));
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < with.unknown_count(); ++i) {
    const bool is_own = i < with.own_count() && with.own_parameters()[i].term == &term;
    if (!is_own) unknowns[next++] = fit.unknowns[to_index(i)];
  }
  return unknowns;
}

/// What a term changes in the block means, all else held; nothing where it cannot be simulated without the term.
std::optional<Eigen::VectorXd> find_change(const Study& study, const Fit& fit, const Term& term) {
  Hypothesis fewer = fit.hypothesis;
  fewer.terms.erase(
      std::remove_if(fewer.terms.begin(), fewer.terms.end(), [&](const SignedTerm& one) { return one.term == &term; }),
      fewer.terms.end());
  const Model without = study.make_model(fewer);
  Eigen::VectorXd simulated;
  const Eigen::VectorXd unknowns = leave_out_own(study.make_model(fit.hypothesis), without, fit, term);
  if (!without.simulate(unknowns, 1, simulated, nullptr)) return std::nullopt;
  return fit.simulated - simulated;
}

/// The f_k of each block.
Eigen::MatrixXd find_forms(const PreparedSet& set, const Series& series) {
  const PreparedRun& run = set.runs()[series.run];
  const auto& tire = set.context().tire.rolling_resistance;
  Eigen::MatrixXd forms(to_index(series.size()), kLawForms);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto mean = [&](const Quantity& input) { return find_mean_input(set, series, k, input); };
    const double speed_km_h = 3.6 * mean(models::quantities::kSpeed);
    const double load = mean(models::quantities::kLoad) / tire.reference_load_N;
    forms.row(to_index(k)) << 1.0, (speed_km_h - 80.0) / 40.0, 2.0 * (load - 1.0),
        std::exp(-(series.time_s[k] - run.measured.time_s.front()) / 600.0),
        (run.measured.cold_pressure_Pa - tire.reference_pressure_Pa) / 5e4,
        (mean(models::quantities::kAmbient) - 298.15) / 10.0;
  }
  return forms;
}

}  // namespace

std::optional<Fit> loosen_laws(const Study& study, const Fit& fit, const std::vector<const Term*>& terms) {
  const PreparedSet& set = study.set;
  const Eigen::Index of_term = kLawForms * to_index(set.channels().size());
  RowMatrix columns = RowMatrix::Zero(to_index(set.residual_count()), of_term * to_index(terms.size()));
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::optional<Eigen::VectorXd> change = find_change(study, fit, *terms[t]);
    if (!change.has_value()) return std::nullopt;
    const double share = std::max(thresholds::kLooseLawShare, terms[t]->info().law_error.law_share);
    for (const Series& series : set.series()) {
      const Eigen::VectorXd wrong = share * series.rows_of(*change);
      const Eigen::Index first = to_index(t) * of_term + kLawForms * to_index(series.channel);
      series.rows_of(columns).middleCols(first, kLawForms) = wrong.asDiagonal() * find_forms(set, series);
    }
  }
  whiten(set, columns);
  Fit loose = fit;
  const Eigen::Index known = fit.jacobian.cols();
  loose.jacobian.resize(columns.rows(), known + columns.cols());
  loose.jacobian << fit.jacobian, -columns;  // a residual is what was measured minus what is simulated
  loose.unknowns.conservativeResize(known + columns.cols());
  loose.unknowns.tail(columns.cols()).setZero();
  return loose;
}

}  // namespace rollrig::diagnosis
