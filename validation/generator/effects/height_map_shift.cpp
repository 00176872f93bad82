/// Outside of the catalog: the heights come from a map at a place behind or ahead of the vehicle.
#include <algorithm>
#include <vector>

#include "sim/core/units.h"
#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::height_map_shift {

/// Heights over the way of a trip, linear between rows.
class Profile {
 public:
  explicit Profile(const RunRecord& record) : heights_m_(record.elevation_m), way_m_(record.time_s.size(), 0.0) {
    for (std::size_t row = 1; row < way_m_.size(); ++row) {
      const double mean_m_s = (record.speed_km_h[row - 1] + record.speed_km_h[row]) / 7.2;
      way_m_[row] = way_m_[row - 1] + mean_m_s * (record.time_s[row] - record.time_s[row - 1]);
    }
  }

  double way_m(std::size_t row) const { return way_m_[row]; }
  /// Rise over way about a place; level beyond the ends.
  double slope(double way_m) const {
    constexpr double kHalf_m = 10.0;
    return (height_m(way_m + kHalf_m) - height_m(way_m - kHalf_m)) / (2.0 * kHalf_m);
  }

 private:
  double height_m(double way_m) const {
    const auto after = std::upper_bound(way_m_.begin(), way_m_.end(), way_m);
    if (after == way_m_.begin()) return heights_m_.front();
    if (after == way_m_.end()) return heights_m_.back();
    const auto row = static_cast<std::size_t>(after - way_m_.begin());
    const double part = (way_m - way_m_[row - 1]) / (way_m_[row] - way_m_[row - 1]);
    return heights_m_[row - 1] + part * (heights_m_[row] - heights_m_[row - 1]);
  }

  std::vector<double> heights_m_;
  std::vector<double> way_m_;
};

/// The force has the slope where the vehicle is, the record that of the map: m g (s(way + shift) - s(way)).
void make_height_map_shift(Making& of) {
  const double shift_m = of.size;
  of.effect.trace = [=](RunRecord& record) {
    const Profile profile(record);
    const double weight_N = record.specimen->truth(Base::kMass) * kStandardGravity_m_s2;
    for (std::size_t row = 0; row < record.force.size(); ++row) {
      if (record.speed_km_h[row] <= 0.0) continue;
      const double way_m = profile.way_m(row);
      record.force[row] += record.lever * weight_N * (profile.slope(way_m + shift_m) - profile.slope(way_m));
    }
  };
}

const EffectKind kind{
    "height_map_shift",
    {"m", "way by which the vehicle is ahead of the place of its height", 0.0, -1000.0, 1000.0,
     log_normal(20.0, 150.0, 15.0, 250.0), true},
    {{"only", "the force has the slope of a place further on, or further back, than the recorded height",
      make_height_map_shift}},
    on_roads,
    on_roads,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::height_map_shift
