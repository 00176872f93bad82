#pragma once
/// A set whose truth is known, simulated again with other causes and other base parameters, without noise.

#include <Eigen/Core>
#include <vector>

#include "validation/generator/laboratory.h"
#include "validation/generator/sample_blocks.h"

namespace rollrig::generator {

/// Signals are what a cause changes in all channels and runs: whitened means over 10 s of the samples that the set has,
/// the force from 30 s after each change of load on.
class KnownSet {
 public:
  /// With further runs after its own.
  explicit KnownSet(const SetOrder& order, std::vector<RunPlan> further = {});

  /// Of the set's own effects.
  Eigen::VectorXd signal() const;
  /// Of one of them alone, with its own size, form and shape.
  Eigen::VectorXd signal_of(std::size_t effect) const;
  /// Of another effect at typical sizes, a column each: both forms at the middle one, one form at a small one, the
  /// other at a large one, each with a shape of its own.
  Eigen::MatrixXd signatures(const EffectKind& kind) const;
  /// What the observer does not know, a column each of one prior standard deviation: offsets of the sensors by session,
  /// base parameters that the files give an uncertainty of.
  Eigen::MatrixXd unknowns() const;
  /// Effects of the catalog that validation sets may have in such a case.
  std::vector<const EffectKind*> rivals() const;

  using Change = std::vector<Columns>;  // of what perfect sensors show: channels by run

  /// What the set's own effects change, by row.
  Change find_change() const { return subtract_baseline(with_); }
  /// What of it is left where offsets and base parameters are fitted to the set by one who knows no effect.
  /// Equation  s - sum_k x_k u_k,  x = (I + U^T U)^-1 U^T s with s and U whitened
  /// Symbols   s the change, u_k what the k-th unknown changes by one prior standard deviation
  /// Checked   tests/validation/generator/changes_test.cpp
  Change find_change_after_retuning() const;

  const Laboratory& lab() const { return lab_; }
  /// Whether a sample is compared, by row.
  const std::vector<bool>& samples(std::size_t run, std::size_t channel) const { return samples_[run][channel]; }

 private:
  Change drive(const Specimen& specimen, const Effects& effects) const;
  /// A row that one of both cannot show, since brakes act there, counts as unchanged.
  Change subtract_baseline(Change driven) const;
  Eigen::VectorXd whiten(const Change& change) const;
  std::vector<Change> offsets() const;
  std::vector<Change> list_unknowns() const;
  Eigen::MatrixXd whiten_all(const std::vector<Change>& changes) const;

  SetOrder order_;
  Laboratory lab_;
  Change with_;
  Change without_;
  std::vector<std::vector<std::vector<bool>>> samples_;  // by run, channel and row
  std::vector<std::vector<SampleBlocks>> blocks_;        // by run and channel
  Eigen::Index rows_ = 0;
};

}  // namespace rollrig::generator
