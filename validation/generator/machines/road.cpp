/// A vehicle on the road. The traction force is measured. Driven are trips in the traffic of town, country and
/// motorway, over hills, in all seasons.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::road {

using boost::math::constants::two_pi;

/// How fast traffic flows, and how often it stops.
struct Road {
  double low_km_h;
  double high_km_h;
  double change_s;     // mean time that a wish for a speed lasts
  double stop_chance;  // that it ends at rest
  double rate_m_s2;    // of accelerating
};
constexpr Road kTown{30.0, 55.0, 40.0, 0.45, 1.3};
constexpr Road kCountry{65.0, 100.0, 90.0, 0.08, 1.0};
constexpr Road kMotorway{100.0, 130.0, 200.0, 0.0, 0.7};

/// A driver who follows a wished speed softly, with small waves on it, in the traffic of one kind of road.
void drive(Draws& draws, const Road& road, double until_s, SpeedTrace& trace) {
  double wave_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  while (trace.now_s() < until_s) {
    const bool stops = draws.happens(road.stop_chance);
    const double wish_m_s = draws.uniform(road.low_km_h, road.high_km_h) / 3.6;
    const double end_s = trace.now_s() + road.change_s * draws.uniform(0.4, 1.6);
    while (trace.now_s() < end_s) {
      wave_m_s = 0.9 * wave_m_s + 0.12 * draws.normal();
      const double aim_m_s2 = std::clamp((wish_m_s + wave_m_s - trace.speed_m_s()) / 4.0, -1.6, road.rate_m_s2);
      acceleration_m_s2 += std::clamp(aim_m_s2 - acceleration_m_s2, -0.6, 0.6);
      trace.add(trace.speed_m_s() + acceleration_m_s2);
    }
    if (!stops) continue;
    trace.ramp(0.0, draws.uniform(0.8, 2.2));
    trace.hold(draws.whole(3, 40));
    acceleration_m_s2 = 0.0;
  }
}

/// Height over way: hills of several lengths.
struct Hills {
  std::array<double, 3> height_m{};
  std::array<double, 3> length_m{};
  std::array<double, 3> phase{};

  explicit Hills(Draws& draws) {
    const std::array<double, 3> longest{9000.0, 2500.0, 700.0};
    for (std::size_t i = 0; i < 3; ++i) {
      length_m[i] = longest[i] * draws.uniform(0.6, 1.4);
      height_m[i] = length_m[i] / two_pi<double>() * draws.uniform(0.001, 0.011);  // steepest 0.1 to 1.1 %
      phase[i] = draws.uniform(0.0, two_pi<double>());
    }
  }
  double at(double way_m) const {
    double height = 200.0;
    for (std::size_t i = 0; i < 3; ++i)
      height += height_m[i] * std::sin(two_pi<double>() * way_m / length_m[i] + phase[i]);
    return std::round(1e3 * height) / 1e3;
  }
};

std::vector<Leg> make_legs(const SpeedTrace& trace, const Hills& hills, double load_N) {
  const std::vector<double>& speeds = trace.speeds_m_s();
  std::vector<Leg> legs;
  double way_m = 0.0;
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
    Leg leg{static_cast<double>(i), 1.0, speeds[i], speeds[i + 1], load_N};
    leg.start_distance_m = way_m;
    leg.start_elevation_m = hills.at(way_m);
    way_m += leg.mean_m_s();
    leg.end_elevation_m = hills.at(way_m);
    legs.push_back(leg);
  }
  return legs;
}

/// Town, country, motorway and back, or part of it.
std::vector<Leg> draw_legs(Draws& draws, const std::string& kind, double load_N) {
  SpeedTrace trace;
  const Hills hills(draws);
  trace.hold(draws.whole(4, 20));
  const auto go = [&](const Road& road, int least_min, int most_min) {
    drive(draws, road, trace.now_s() + 60.0 * draws.whole(least_min, most_min), trace);
  };
  if (kind == "commute") {
    go(kTown, 5, 9), go(kCountry, 8, 16), go(kTown, 5, 9);
  } else if (kind == "motorway") {
    go(kTown, 3, 6), go(kMotorway, 20, 35), go(kTown, 3, 6);
  } else {
    go(kTown, 4, 7), go(kCountry, 7, 12), go(kMotorway, 10, 18), go(kCountry, 4, 8);
  }
  trace.ramp(0.0, 1.0);
  trace.hold(5.0);
  return make_legs(trace, hills, load_N);
}

Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) {
  constexpr std::array<const char*, 3> kKinds{"commute", "motorway", "journey"};
  Draws draws(order.seed, "campaign");
  const double year_degC = draws.uniform(8.0, 18.0);
  const double load_N = specimen.truth(Base::kMass) * kStandardGravity_m_s2 / specimen.tires;
  Campaign campaign{"trips", {}};
  int day = 0;
  double day_degC = 0.0;
  for (int i = 0; i < order.runs; ++i) {
    Draws own(order.seed, fmt::format("run/{}", i));
    const bool warm = i > 0 && own.happens(0.3);  // right after another trip of the same day
    if (!warm) {
      ++day;
      day_degC = year_degC + own.uniform(-12.0, 14.0);
    }
    const std::string kind = kKinds[static_cast<std::size_t>(own.whole(0, 2))];
    RunPlan run;
    run.id = fmt::format("trip-{}", i + 1);
    run.index = static_cast<std::size_t>(i);
    run.session = fmt::format("day-{}", day);
    run.cold_pressure_kPa = specimen.reference_pressure_kPa;
    run.air = draw_air(own, day_degC);
    run.started_warm = warm;
    run.initial_degC = std::round(10.0 * (run.air.at(0.0) + (warm ? own.uniform(10.0, 20.0) : 0.0))) / 10.0;
    run.legs = draw_legs(own, kind, load_N);
    campaign.runs.push_back(std::move(run));
  }
  return campaign;
}

bool gives(const Specimen& specimen, Base which) {
  if (specimen.constant_rrc) return which >= Base::kMass;
  return which <= Base::kF || (which >= Base::kMass && which < Base::kRrc);
}

std::string write_set_keys(const Specimen& specimen) {
  return fmt::format("kind = \"road\"\nvehicle = \"vehicle.toml\"\nbaseline = \"{}\"\n", name_of_law(specimen));
}

std::string write_file(const Specimen& specimen) {
  return "format = \"rollrig-vehicle/1\"\nname = \"car\"\n" + write_identified(specimen, Base::kMass, Base::kDragArea) +
         fmt::format("tires = {:.0f}\n\n[powertrain]\nregeneration_limit_m_s2 = {:.10g}\n", specimen.tires,
                     specimen.regeneration_m_s2) +
         fmt::format("regeneration_fade_km_h = {:.10g}\n", 3.6 * specimen.regeneration_fade_m_s);
}

/// The vehicle's bearings are in what is called its tires' loss.
void draw_own(std::uint64_t, Specimen& specimen) {
  for (const Base none : {Base::kC0, Base::kC1, Base::kC2}) specimen.base[static_cast<std::size_t>(none)].truth = 0.0;
}

double calc_curvature_factor(const Specimen& specimen) {
  return specimen.constant_rrc ? 1.0 : calc_flat_factor(specimen);
}

double calc_moving_mass_kg(const Specimen& specimen, double, double) {
  return specimen.truth(Base::kMass) + specimen.truth(Base::kRotatingMass);
}

// Assumed: a force on the road has unevenness, gusts and gear noise in it, less than a trip in traffic has.
const Machine machine{
    "road",
    "vehicle.toml",
    Measured::kVehicle,
    false,
    true,
    true,
    {columns::kTime, columns::kSpeed, {"elevation_m", &RunRecord::elevation_m, "{:.9g}"}, columns::kAmbient},
    {{"traction_force_N", "vehicle", {8.0, 40.0, 13.0, 60.0, 0.0}}},
    {{"road", 6, ""}},
    gives,
    write_set_keys,
    write_file,
    draw_own,
    draw_campaign,
    calc_curvature_factor,
    find_unit_lever,
    calc_moving_mass_kg};

}  // namespace rollrig::generator::road
