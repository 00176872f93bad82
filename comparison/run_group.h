#pragma once
/// Runs of several sets that belong together, phase by phase.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "comparison/compared.h"
#include "comparison/mean_difference.h"
#include "comparison/overlay.h"
#include "diagnosis/comparison/run_phases.h"
#include "measurements/measurement_set.h"

namespace rollrig::comparison {

/// Runs of all sets that belong together; the first is that of the reference.
struct RunGroup {
  std::vector<std::optional<std::size_t>> runs;

  bool is_complete() const;
};

/// Means of two runs over the times that both have.
struct PairedMeans {
  double reference = 0.0;
  double other = 0.0;
  UncertainMean difference;
};

/// Names of phases of a run, each with that of the phase of the reference that differs from it in its load alone.
using RenamedPhases = std::vector<std::pair<std::string, std::string>>;

/// "drum_torque_less_skim_Nm"
std::string name_less_skim(const Quantity& force);

/// One group of runs with the phases of each. Sets and group must outlive it.
class GroupComparison {
 public:
  GroupComparison(const std::vector<measurements::MeasurementSet>& sets, const RunGroup& group);

  const measurements::MeasuredRun& run(std::size_t set) const { return sets_[set].runs[*group_.runs[set]]; }
  const std::vector<diagnosis::RunPhase>& phases(std::size_t set) const { return phases_[set]; }
  /// Which phases are compared though their loads differ, a sentence each; `names` are those of the sets.
  std::vector<std::string> describe_loads(const std::vector<std::string>& names) const;
  /// "warm-up, 80 km/h 5.4 kN" of a phase of the reference; "warm-up, 80 km/h, 5.4 and 6.9 kN" where loads differ.
  std::string name_place(const diagnosis::RunPhase& phase) const;
  /// "5.4 kN" of each set in a phase of the reference, empty for a set without it; nothing where all have one load.
  std::vector<std::string> list_loads(const diagnosis::RunPhase& phase) const;

  /// Mean load of a set in a phase of the reference; none where it has not this phase.
  std::optional<double> calc_mean_load_N(std::size_t set, const diagnosis::RunPhase& phase) const;

  /// A value for each channel and phase of the reference that another run has as well, and of the force channel that
  /// less skim: the zero of the sensor cancels, and the loss of the machine.
  void add_values(Comparison& comparison) const;
  /// The run of a set, to be laid over those of the others.
  OverlaidRun lay(std::size_t set) const;

 private:
  using FindMeans = std::function<std::optional<PairedMeans>(std::size_t other)>;

  bool has(std::size_t set) const { return group_.runs[set].has_value(); }
  /// Means of a channel in a phase of the reference and of another set.
  std::optional<PairedMeans> find_means(std::size_t other, const diagnosis::RunPhase& phase,
                                        const Quantity& channel) const;
  /// The same, whose uncertainty contains the zeros of the sensors in two sessions.
  std::optional<PairedMeans> find_means_with_zeros(std::size_t other, const diagnosis::RunPhase& phase,
                                                   const Quantity& channel) const;
  /// A value of all sets, by the means of each.
  std::optional<ComparedValue> make_value(const diagnosis::RunPhase& phase, const Quantity& channel,
                                          const FindMeans& find) const;
  std::optional<ComparedValue> make_less_skim(const diagnosis::RunPhase& phase) const;
  /// The skim phase of the reference at the speed of another phase; nullptr where there is none.
  const diagnosis::RunPhase* find_skim(const diagnosis::RunPhase& loaded) const;
  double calc_speed_m_s(const diagnosis::RunPhase& phase) const;

  const std::vector<measurements::MeasurementSet>& sets_;
  const RunGroup& group_;
  std::vector<std::vector<diagnosis::RunPhase>> phases_;  // of one kind of motion with the names of the reference
  std::vector<RenamedPhases> renamed_;
};

}  // namespace rollrig::comparison
