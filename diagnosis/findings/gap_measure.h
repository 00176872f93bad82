#pragma once
/// Differences of a measured set and a simulation, in noise floors, in units of the channels and as energy.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/findings/energy_scale.h"
#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// Squares of the differences minus those of the noise, summed over blocks. A resample draws those of stretches.
struct StretchSquares {
  double above = 0.0;   // the noise
  double blocks = 0.0;  // number of blocks

  void add(const StretchSquares& other);
  double gap() const;  // root of the mean of `above`, 0 where it is negative
};

/// Sums over the differences of some runs.
struct Measure {
  std::map<std::pair<std::size_t, std::size_t>, StretchSquares> stretches;  // by run and phase, in noise floors
  std::vector<StretchSquares> channels;                                     // squares in SI
  std::map<std::size_t, EnergyShare> energies;                              // by run
};

/// The set, and the energy of its blocks, by which differences are measured.
struct Scale {
  const PreparedSet& set;
  EnergyScale energy;
};

/// Adds the differences of one run in all channels, after their offsets have been estimated again and subtracted: of
/// all phases, or of those in `counted`.
void add_run(const Scale& scale, std::size_t run, const Eigen::VectorXd& difference, Measure& measure,
             const std::set<std::size_t>* counted = nullptr);
/// All runs, measured minus `simulated`.
Measure measure_runs(const Scale& scale, const Eigen::VectorXd& simulated);
/// The candidate with its base parameters at the files' values: only its own parameters and offsets are fitted. Empty
/// where that cannot be simulated.
Measure measure_as_calibrated(const Study& study, const Scale& scale, const Candidate& candidate);

/// In noise floors: root of the mean square over all blocks and channels, without noise.
double gap_of(const Measure& measure);
/// By how much the energy of a run is off: root of the mean square over runs; none if no run takes energy.
std::optional<double> find_energy_percent(const Measure& measure);

/// Root of the mean square of a channel without noise, in the unit of the report.
struct ChannelRms {
  std::string channel;
  std::string unit;
  double rms = 0.0;
};
/// Zeros where no run could be simulated.
std::vector<ChannelRms> list_channel_rms(const PreparedSet& set, const Measure& measure);

}  // namespace rollrig::diagnosis
