/// Wind along the road, in gusts or by the turns of the road, and a slope that the map does not have.
#include <array>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class WindAndGrade : public Effect {
 public:
  explicit WindAndGrade(const Making& of) : Effect(of), wind_m_s_(of.size) {
    gusts_ = of.draws.uniform(0.1, 0.3);
    days_ = of.draws.uniform(0.0, 0.3);
    slope_ = 0.01 * of.draws.uniform(-0.25, 0.25);
    side_ = of.draws.uniform(0.0, 0.05);
    for (double& phase : phases_) phase = of.draws.uniform(0.0, 6.2831853);
    shape = {{"gusts_share", gusts_},
             {"days_share", days_},
             {"slope_percent_at_5_m_s", 100.0 * slope_},
             {"drag_of_side_wind", side_}};
  }

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* run) const override {
    run[0] = 1.0 + days_ * std::sin(2.4 * static_cast<double>(start.index) + phases_[0]);
  }

  void act(const double* run, Instant& now) const override {
    double gusts = 0.0;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      gusts += std::sin(now.time_s / kPeriods_s[i] + phases_[i]) / std::sqrt(0.5 * static_cast<double>(phases_.size()));
    }
    now.wind_m_s += wind_m_s_ * run[0] * (1.0 + gusts_ * gusts);
    const double strength = std::abs(wind_m_s_) / 5.0;
    now.drag_factor *= 1.0 + side_ * strength;
    now.body_force_N += now.specimen->truth(Base::kMass) * kStandardGravity_m_s2 * slope_ * strength;
  }

 private:
  static constexpr std::array<double, 5> kPeriods_s{4.0, 9.0, 21.0, 47.0, 110.0};  // over 2 pi

  double wind_m_s_;
  double gusts_ = 0.0;
  double days_ = 0.0;
  double slope_ = 0.0;
  double side_ = 0.0;
  std::array<double, 5> phases_{};
};

/// Wind that the turns of the road bring more or less against the vehicle: sines of the distance.
class TurningRoad : public Effect {
 public:
  explicit TurningRoad(const Making& of) : Effect(of), wind_m_s_(of.size) {
    turning_ = of.draws.uniform(0.2, 0.5);
    slope_ = 0.01 * of.draws.uniform(-0.25, 0.25);
    side_ = of.draws.uniform(0.0, 0.05);
    for (double& phase : phases_) phase = of.draws.uniform(0.0, 6.2831853);
    shape = {{"turning_share", turning_}, {"slope_percent_at_5_m_s", 100.0 * slope_}, {"drag_of_side_wind", side_}};
  }

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* run) const override { run[0] = 2.4 * static_cast<double>(start.index); }

  void act(const double* run, Instant& now) const override {
    double turns = 0.0;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      turns += std::sin(now.distance_m / kLengths_m[i] + phases_[i] + run[0]);
    }
    now.wind_m_s += wind_m_s_ * (1.0 + turning_ * turns / std::sqrt(0.5 * static_cast<double>(phases_.size())));
    const double strength = std::abs(wind_m_s_) / 5.0;
    now.drag_factor *= 1.0 + side_ * strength;
    now.body_force_N += now.specimen->truth(Base::kMass) * kStandardGravity_m_s2 * slope_ * strength;
  }

 private:
  static constexpr std::array<double, 4> kLengths_m{90.0, 250.0, 700.0, 1800.0};  // over 2 pi; Assumed

  double wind_m_s_;
  double turning_ = 0.0;
  double slope_ = 0.0;
  double side_ = 0.0;
  std::array<double, 4> phases_{};
};

}  // namespace

const EffectKind kind_wind_and_grade{
    "wind_and_grade",
    {"m/s", "mean wind against the vehicle", 0.0, -20.0, 20.0, normal(-5.0, 5.0, -8.0, 8.0), false, 0.8},
    {{"gusts",
      "mean wind with gusts of five periods and a spread over the trips, drag of its side part, and a slope in "
      "proportion",
      make_law<WindAndGrade>},
     {"turning_road",
      "mean wind that the turns of the road bring more or less against the vehicle, by distance, drag of its side "
      "part, and a slope in proportion",
      make_law<TurningRoad>}},
    kRoadGrounds,
    kRoadGrounds};

}  // namespace rollrig::generator
