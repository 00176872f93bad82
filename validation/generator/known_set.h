#pragma once
/// A set whose truth is known, simulated again with other causes and other base parameters, without noise.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "validation/generator/laboratory.h"
#include "validation/generator/sample_blocks.h"

namespace rollrig::generator {

/// Signals are what a cause changes in all channels and runs: whitened means over 10 s of the samples that the set
/// has, the force from 30 s after each change of load on.
class KnownSet {
 public:
  explicit KnownSet(const SetOrder& order);

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

 private:
  using Campaigned = std::vector<Columns>;  // channels by run

  Campaigned drive(const Specimen& specimen, const Effects& effects) const;
  Eigen::VectorXd whiten(const Campaigned& with) const;
  std::vector<Eigen::VectorXd> offsets() const;

  SetOrder order_;
  Laboratory lab_;
  Campaigned with_;
  Campaigned without_;
  std::vector<std::vector<SampleBlocks>> blocks_;  // by run and channel
  Eigen::Index rows_ = 0;
};

}  // namespace rollrig::generator
