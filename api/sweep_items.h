#pragma once
/// The points of a sweep as items.

#include <map>
#include <string>
#include <vector>

#include "api/watched_items.h"
#include "rollrig/sweep.h"
#include "scenarios/run/scenario.h"

namespace rollrig {

using SweepPoint = std::vector<std::string>;  // a value of each axis

/// Each point has the seed of the sweep, so that they differ by the axes alone.
class SweepItems : public WatchedItems {
 public:
  SweepItems(SweepInput input, std::vector<SweepPoint> points) : input_(std::move(input)), points_(std::move(points)) {}

  std::size_t count() const override { return points_.size(); }
  Json describe(std::size_t item) const override;
  /// `result` and `manifest` of the run.
  Json carry_out(std::size_t item, std::uint64_t seed) const override;
  std::uint64_t calc_seed(std::size_t, std::uint64_t sweep_seed) const override { return sweep_seed; }

  const SweepInput& input() const { return input_; }
  const std::vector<SweepPoint>& points() const { return points_; }
  scenarios::RunSpec read(std::size_t item) const;
  /// The values of the axes as people read them: of an axis of tires the tires' names. To be called after check().
  std::vector<SweepPoint> list_shown_points() const;
  /// Reads all points, and watches their files from then on. If finished points are saved, it also carries out one in
  /// the quicker fidelity, for the files that are read only then. Throws InputError where one is wrong.
  void check();
  /// All that the results depend on, as a text: two sweeps have the same if their results are the same.
  std::string define(std::uint64_t seed) const;

 private:
  /// As read(), and throws InputError where the run cannot be prepared.
  scenarios::RunSpec prepare(std::size_t item) const;
  /// Throws InputError where a tire file was varied under another spelling before.
  void require_one_spelling(const std::string& path, const std::string& given);

  SweepInput input_;
  std::vector<SweepPoint> points_;
  std::vector<CampaignFile> files_;
  std::map<std::string, std::string> tire_names_;  // by what an axis of tires says
  std::map<std::string, std::string> tire_files_;  // what an axis of tires says by the path of the file
};

}  // namespace rollrig
