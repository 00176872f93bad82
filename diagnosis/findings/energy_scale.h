#pragma once
/// Differences of readings as a share of the energy that a tire or a vehicle takes.

#include <optional>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::diagnosis {

/// The energy of each block of the channel of force, and what an error of its reading makes of it. On rigs it is what
/// the tire takes under load: (reading less parasitic loss of the rig's file) times speed. On the road it is what the
/// vehicle takes where it is driven: traction force times speed where the force is positive. Energy over distance is
/// the mean rolling resistance: a share of one is a share of the other.
/// Equation  share = sum F_error v n / sum F v n over the blocks of a run that count
/// Symbols   F force in N, v speed, n samples of the block
/// Validity  blocks that are compared; samples at equal times
/// Checked   tests/diagnosis/energy_scale_test.cpp
class EnergyScale {
 public:
  explicit EnergyScale(const PreparedSet& set);

  /// Of the residual's block; 0 in other channels, in skim, and on the road where the vehicle is not driven.
  double energy(std::size_t residual) const { return energy_[to_index(residual)]; }
  double energy_per_SI(std::size_t residual) const { return per_SI_[to_index(residual)]; }

  /// Root of the mean square, over runs, of the share of their energy that block differences in SI units are, in
  /// percent; none where no run takes energy.
  std::optional<double> calc_percent(const Eigen::VectorXd& difference) const;

 private:
  const PreparedSet& set_;
  Eigen::VectorXd energy_;
  Eigen::VectorXd per_SI_;
};

/// What an error of a run's energy adds up from.
struct EnergyShare {
  double error = 0.0;
  double energy = 0.0;
};

/// Root of the mean square of the shares, in percent; runs without energy do not count. None where there is none.
std::optional<double> calc_rms_percent(const std::vector<EnergyShare>& runs);

}  // namespace rollrig::diagnosis
