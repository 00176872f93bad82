#pragma once
/// Differences of readings as a share of the energy that a tire or a vehicle takes.

#include <optional>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::diagnosis {

/// The energy of each block of the force channel, and how an error of the reading changes it. On rigs, it is the energy
/// that the tire takes under load: (reading minus parasitic loss of the rig's file) times speed. On the road, it is the
/// energy that drives the vehicle: traction force times speed where the force is positive. Energy over distance is the
/// mean rolling resistance, so a percentage of one is the same percentage of the other.
/// Equation  share = sum F_error v n / sum F v n over the blocks of a run that count
/// Symbols   F force in N, F_error its error, v speed, n number of samples of the block. Energies are in W times
///           samples: the sampling interval cancels in the share
/// Validity  blocks that are compared; samples at equal intervals
/// Checked   tests/diagnosis/energy_scale_test.cpp
class EnergyScale {
 public:
  explicit EnergyScale(const PreparedSet& set);

  /// Of the block of a residual, and its change by an error of the reading of one SI unit. Both are 0 in other
  /// channels, in skim, and where the force is not positive.
  double energy(std::size_t residual) const { return energy_[to_index(residual)]; }
  double energy_per_SI(std::size_t residual) const { return per_SI_[to_index(residual)]; }

  /// The error of the energy of a run that differences of block means, in SI units, add up to: root of the mean square
  /// over runs, in percent of their energy. None if no run takes energy.
  std::optional<double> calc_percent(const Eigen::VectorXd& difference) const;

 private:
  const PreparedSet& set_;
  Eigen::VectorXd energy_;
  Eigen::VectorXd per_SI_;
};

/// Energy of a run and its error, in the unit of EnergyScale.
struct EnergyShare {
  double error = 0.0;
  double energy = 0.0;
};

/// Root of the mean square of error over energy, in percent. Runs without energy do not count; none if there is no
/// other.
std::optional<double> calc_rms_percent(const std::vector<EnergyShare>& runs);

}  // namespace rollrig::diagnosis
