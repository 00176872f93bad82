// What kinds share in which a carriage presses one tire on the surface: their runs, and the mass that turns.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/generator/machine.h"

namespace rollrig::generator::carriage {
namespace {

/// Builds the legs of a run from what an operator would do.
class Course {
 public:
  explicit Course(double load_N) : load_N_(load_N) {}

  double now_s() const { return legs_.empty() ? 0.0 : legs_.back().end_s(); }
  void load(double load_N) { load_N_ = load_N; }
  void hold(double seconds) { add(seconds, speed_m_s_); }
  void hold_until(double time_s) { hold(std::max(60.0, time_s - now_s())); }
  void speed(double speed_km_h, double rate_m_s2) {
    const double target_m_s = speed_km_h / 3.6;
    if (target_m_s == speed_m_s_) return;
    add(std::ceil(std::abs(target_m_s - speed_m_s_) / rate_m_s2), target_m_s);
  }
  std::vector<Leg> take() { return std::move(legs_); }

 private:
  void add(double seconds, double end_m_s) {
    legs_.push_back({now_s(), std::round(seconds), speed_m_s_, end_m_s, load_N_});
    speed_m_s_ = end_m_s;
  }

  double load_N_;
  double speed_m_s_ = 0.0;
  std::vector<Leg> legs_;
};

/// What one laboratory does in the same way in each run.
struct Habits {
  double load_N = 5400.0;
  double skim_N = 200.0;
  double rate_m_s2 = 0.5;
  double skim_s = 180.0;
  bool skims_first = false;
  bool skims_last = true;
};

using Legs = std::vector<Leg>;

void skim(Course& course, const Habits& habits, double seconds) {
  course.load(habits.skim_N);
  course.hold(seconds);
  course.load(habits.load_N);
}

Legs warm_up(Draws& draws, const Habits& habits, double speed_km_h) {
  Course course(habits.skims_first ? habits.skim_N : habits.load_N);
  course.speed(speed_km_h, habits.rate_m_s2);
  if (habits.skims_first) skim(course, habits, habits.skim_s);
  course.hold(10.0 * draws.whole(180, 260));
  if (habits.skims_last) skim(course, habits, habits.skim_s);
  course.hold_until(2000.0);
  return course.take();
}

/// Steps of speed in a drawn order, the fastest among them.
Legs speed_steps(Draws& draws, const Habits& habits) {
  Course course(habits.load_N);
  course.speed(80.0, habits.rate_m_s2);
  course.hold(10.0 * draws.whole(80, 120));
  std::vector<double> speeds{40.0, 100.0, 120.0, 5.0 * draws.whole(25, 27)};
  if (draws.happens(0.5)) speeds.push_back(60.0);
  draws.shuffle(speeds);
  if (draws.happens(0.4)) std::sort(speeds.begin(), speeds.end());
  for (const double speed_km_h : speeds) {
    course.speed(speed_km_h, habits.rate_m_s2);
    course.hold(10.0 * draws.whole(28, 42));
  }
  course.speed(80.0, habits.rate_m_s2);
  if (habits.skims_last) {
    course.hold(60.0);
    skim(course, habits, habits.skim_s);
  }
  course.hold_until(2100.0);
  return course.take();
}

Legs load_sweep(Draws& draws, const Habits& habits) {
  Course course(habits.skim_N);
  course.speed(80.0, habits.rate_m_s2);
  skim(course, habits, habits.skim_s);
  course.hold(10.0 * draws.whole(80, 110));
  std::vector<double> shares{0.55, 0.8, 1.2};
  if (draws.happens(0.5)) std::reverse(shares.begin(), shares.end());
  if (draws.happens(0.4)) shares.push_back(1.0);
  for (const double share : shares) {
    course.load(std::round(habits.load_N * share / 50.0) * 50.0);
    course.hold(10.0 * draws.whole(32, 45));
  }
  skim(course, habits, habits.skim_s + 60.0);
  course.hold_until(2000.0);
  return course.take();
}

Legs transient_skim(Draws& draws, const Habits& habits) {
  Course course(habits.load_N);
  course.speed(80.0, habits.rate_m_s2);
  course.hold(10.0 * draws.whole(70, 110));
  const int skims = draws.whole(2, 3);
  for (int i = 0; i < skims; ++i) {
    skim(course, habits, 10.0 * draws.whole(18, 30));
    course.hold(10.0 * draws.whole(38, 50));
  }
  course.hold_until(2000.0);
  return course.take();
}

/// Speed up and down between two speeds, as in a coarse drive cycle.
Legs up_and_down(Draws& draws, const Habits& habits) {
  Course course(habits.load_N);
  const double low_km_h = 10.0 * draws.whole(4, 6);
  for (int i = 0; i < 4; ++i) {
    course.speed(i % 2 == 0 ? low_km_h : 120.0, habits.rate_m_s2);
    course.hold(10.0 * draws.whole(38, 52));
  }
  course.speed(80.0, habits.rate_m_s2);
  if (habits.skims_last) skim(course, habits, habits.skim_s);
  course.hold_until(2200.0);
  return course.take();
}

Legs draw_legs(Draws& draws, const Habits& habits, const std::string& kind) {
  if (kind == "speed steps") return speed_steps(draws, habits);
  if (kind == "load sweep") return load_sweep(draws, habits);
  if (kind == "transient skim") return transient_skim(draws, habits);
  if (kind == "up and down") return up_and_down(draws, habits);
  const std::string warm_up_kind = "warm-up ";
  if (kind.rfind(warm_up_kind, 0) == 0) return warm_up(draws, habits, std::stod(kind.substr(warm_up_kind.size())));
  throw std::logic_error("unknown kind of run: " + kind);
}

Habits draw_habits(Draws& draws, const Specimen& specimen) {
  Habits habits;
  habits.load_N = 100.0 * draws.whole(50, 58);
  habits.skim_N = specimen.skim_load_N;
  habits.rate_m_s2 = draws.uniform(0.35, 0.9);
  habits.skim_s = 10.0 * draws.whole(15, 24);
  habits.skims_first = draws.happens(0.35);
  habits.skims_last = draws.happens(0.75);
  return habits;
}

}  // namespace

Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen, const std::vector<CampaignKind>& kinds) {
  constexpr Cooling kCooling{8.0, 14.0, 60.0};  // Assumed
  Draws draws(order.habits_seed.value_or(order.seed), "campaign");
  const CampaignKind& kind = draws.pick(kinds);
  const Habits habits = draw_habits(draws, specimen);
  return draw_runs(order, kind, kCooling, specimen,
                   [&](Draws& own, const RunKind& what) { return draw_legs(own, habits, what.kind); });
}

double calc_moving_mass_kg(const Specimen& specimen, double load_N, double target_load_N) {
  const double drum_m = 0.5 * specimen.drum_diameter_m;
  const double drum_kg = specimen.drum_inertia_kg_m2 / (drum_m * drum_m);
  if (target_load_N <= 0.0) return drum_kg;  // the wheel is off the drum
  const double wheel_m = 0.5 * specimen.outer_diameter_m - load_N / specimen.vertical_N_per_m;
  return drum_kg + specimen.spin_inertia_kg_m2 / (wheel_m * wheel_m);
}

}  // namespace rollrig::generator::carriage
