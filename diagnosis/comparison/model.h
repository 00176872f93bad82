#pragma once
/// What the sensors of a set would have shown under a hypothesis, as a function of unknowns in prior units.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/comparison/eigen_index.h"
#include "diagnosis/comparison/machine_key.h"
#include "diagnosis/comparison/prepared_set.h"
#include "diagnosis/terms/hypothesis.h"
#include "estimation/normal_prior.h"

namespace rollrig::diagnosis {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Unknowns, each standard normal before the measurement: the terms' own parameters, then the base parameters, then
/// the sensors' offsets (one a session and channel). Base parameters that are correlated share unknowns
/// (estimation::calc_prior_factor). Of joined sets, a base parameter holds on all machines or on the one that its key
/// names (machine_key.h).
class Model {
 public:
  Model(const PreparedSet& set, std::vector<estimation::FreeParameter> base, Hypothesis hypothesis);

  const PreparedSet& set() const { return set_; }
  const Hypothesis& hypothesis() const { return hypothesis_; }
  const std::vector<estimation::FreeParameter>& base() const { return base_; }

  /// Lower triangular: what unknowns move, each base parameter in its own standard deviations, all else in prior units.
  Eigen::MatrixXd moves_by_unknowns() const;

  std::size_t own_count() const { return own_.size(); }
  std::size_t parameter_count() const { return own_.size() + base_.size(); }
  std::size_t unknown_count() const { return parameter_count() + set_.offset_count(); }
  std::size_t residual_count() const { return set_.residual_count(); }

  /// An own parameter of a term: the size is the first.
  struct OwnParameter {
    const Term* term;
    std::size_t term_index;  // in the hypothesis
    const models::EffectParameter* declared;
    std::size_t index;  // in the term
    int sign;

    bool is_size() const { return index == 0; }
    PriorUnits value_at(double u) const { return from_prior_units(*declared, u, sign); }
    PriorBounds bounds() const { return bounds_in_prior_units(*declared, sign); }
  };
  const std::vector<OwnParameter>& own_parameters() const { return own_; }

  /// Block means of every series, SI units, without offsets; `derivatives` by the parameters may be null. Runs are
  /// shared out over threads. False where a parameter leaves its range or the simulation its domain.
  bool simulate(const Eigen::VectorXd& unknowns, int threads, Eigen::VectorXd& values, RowMatrix* derivatives) const;

  /// The same where `values` are those without `added`, the other unknowns alike: only runs on machines on which it
  /// acts are simulated. False as simulate().
  bool simulate_added(const Term& added, const Eigen::VectorXd& unknowns, Eigen::VectorXd& values) const;

  /// Block means of one run alone, into its rows; zero in all others. False as simulate().
  bool simulate_one(std::size_t run, const Eigen::VectorXd& unknowns, Eigen::VectorXd& values) const;

  /// Of one run's block means the derivatives by the first kJetWidth parameters, into the rows of that run.
  bool derive_run(std::size_t run, const Eigen::VectorXd& unknowns, RowMatrix& derivatives) const;

  /// Whitened residuals (measured - simulated - offset) and their derivatives by the unknowns.
  bool evaluate(const Eigen::VectorXd& unknowns, int threads, Eigen::VectorXd& residuals, RowMatrix* jacobian) const;

  /// Measured minus `simulated` minus offsets, block means in SI units.
  Eigen::VectorXd subtract_from_measured(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& simulated) const;

 private:
  struct Parameter {
    double value_SI = 0.0;
    double derivative_SI = 0.0;  // by its own unknown
  };
  template <class S>
  bool simulate_run(std::size_t run, const std::vector<Parameter>& parameters, std::size_t first_column,
                    Eigen::VectorXd& values, RowMatrix* derivatives) const;
  template <class S>
  S make_base(std::size_t i, const std::vector<Parameter>& parameters, std::size_t first_column) const;
  bool find_parameters(const Eigen::VectorXd& unknowns, std::vector<Parameter>& parameters) const;

  const PreparedSet& set_;
  std::vector<estimation::FreeParameter> base_;
  std::vector<MachineKey> base_keys_;
  Eigen::MatrixXd prior_factor_;
  Hypothesis hypothesis_;
  std::vector<OwnParameter> own_;
};

/// Whitens columns of block values (rows as the residuals of the set), in place.
void whiten(const PreparedSet& set, RowMatrix& columns);
void whiten(const PreparedSet& set, Eigen::VectorXd& column);

}  // namespace rollrig::diagnosis
