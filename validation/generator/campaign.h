#pragma once
/// What a laboratory does: runs of speeds and loads in two or three sessions.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/generator/specimen.h"

namespace rollrig::generator {

/// Part of a run between two events: the speed runs linearly, the load stands. Ends lie on whole seconds. On a dyno
/// and on the road a leg lasts one second.
struct Leg {
  double start_s = 0.0;
  double duration_s = 0.0;
  double start_m_s = 0.0;
  double end_m_s = 0.0;
  double load_N = 0.0;
  double start_longitudinal_N = 0.0;  // of one wheel on the roller
  double end_longitudinal_N = 0.0;
  double start_elevation_m = 0.0;
  double end_elevation_m = 0.0;
  double start_distance_m = 0.0;

  double end_s() const { return start_s + duration_s; }
  double acceleration_m_s2() const { return (end_m_s - start_m_s) / duration_s; }
  double mean_m_s() const { return 0.5 * (start_m_s + end_m_s); }
  /// Rise over way, the same all along.
  double slope() const;
};

/// Speeds at whole seconds, from standstill on: what a driver on a dyno or on the road does.
class SpeedTrace {
 public:
  double now_s() const { return static_cast<double>(speeds_m_s_.size()) - 1.0; }
  double speed_m_s() const { return speeds_m_s_.back(); }
  const std::vector<double>& speeds_m_s() const { return speeds_m_s_; }

  /// The speed one second later.
  void add(double speed_m_s);
  void hold(double seconds);
  void ramp(double speed_km_h, double rate_m_s2);
  /// A cycle as published, which starts and ends at rest.
  void cycle(const std::vector<double>& speeds_km_h);

 private:
  std::vector<double> speeds_m_s_{0.0};
};

/// Air at the tire over a run: a slow swing and a slope.
/// Equation  T = mean + swing sin(2 pi t/period + phase) + slope t
struct Air {
  double mean_degC = 25.0;
  double swing_dK = 0.0;
  double period_s = 1500.0;
  double phase = 0.0;
  double slope_K_per_s = 0.0;

  double at(double time_s) const;
};

struct RunPlan {
  std::string id;
  std::string session;
  double cold_pressure_kPa = 280.0;
  double initial_degC = 25.0;
  std::optional<double> rest_before_min;  // none: soaked
  bool started_warm = false;              // right after another run
  Air air;
  std::vector<Leg> legs;
  std::optional<double> surface_degC;               // at which drum or roller is held, and recorded; none: as it goes
  bool reversed = false;                            // turned the other way round
  std::vector<std::pair<double, double>> hung;      // time, and torque or force hung on the force sensor from then on
  bool reads_zero = false;                          // the force is logged while the surface stands
  std::vector<std::pair<double, double>> unread_s;  // from, to: spans in which nothing is logged

  std::size_t index = 0;  // in the campaign

  bool is_read(double time_s) const;
  double find_hung(double time_s) const;

  double end_s() const { return legs.back().end_s(); }
};

/// A run of a campaign on a rig.
struct RunKind {
  const char* kind;
  const char* session;
  double pressure_kPa = 0.0;     // 0: the usual one
  double rest_before_min = 0.0;  // 0: soaked
  double ambient_degC = 0.0;     // 0: the usual one
  double payload = 1.0;          // factor on the wheel's load
};

struct CampaignKind {
  const char* name;
  std::vector<RunKind> runs;
};

/// How much warmer than the air a tire is after a rest: drawn between the two where the rest begins, then decaying.
struct Cooling {
  double least_dK;
  double most_dK;
  double time_constant_min;
};

struct Campaign {
  std::string name;
  std::vector<RunPlan> runs;
};

constexpr int kMostRuns = 6;

struct CampaignOrder {
  std::uint64_t seed = 1;
  int runs = kMostRuns;                           // the first of the campaign
  std::string run_kind;                           // of all runs; empty: as the laboratory has them
  std::optional<std::uint64_t> habits_seed = {};  // of the laboratory and what it does in each run; none: `seed`
};

/// The ordered runs of a laboratory on a rig, each from draws of its own. `draw_legs` gives the legs of a run.
Campaign draw_runs(const CampaignOrder& order, const CampaignKind& kind, const Cooling& cooling,
                   const Specimen& specimen,
                   const std::function<std::vector<Leg>(Draws& own, const RunKind& what)>& draw_legs);

/// Adds runs after those of a campaign.
void add_runs(std::vector<RunPlan> further, Campaign& campaign);

/// Slow swing and slope of the air about `mean_degC`, within a degree or so.
Air draw_air(Draws& draws, double mean_degC);

}  // namespace rollrig::generator
