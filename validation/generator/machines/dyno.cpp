/// One wheel of a vehicle that is tied down on rollers. The loss force between hub and roller is measured. Driven are
/// published cycles, constant speeds, and both mixed, cold and after rests.
#include <algorithm>
#include <cmath>

#include "sim/core/assets.h"
#include "sim/core/csv.h"
#include "sim/core/units.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::dyno {

/// Adds a cycle of the project's assets.
void drive(const std::string& cycle, SpeedTrace& trace) {
  trace.cycle(CsvTable::read(find_asset("cycles", cycle)).plain_numbers("speed_km_h", {}));
}

/// UDDS, highway, UDDS and a constant speed: half of a multi-cycle test.
void multi_cycle(Draws& draws, SpeedTrace& trace) {
  drive("udds", trace);
  trace.hold(draws.whole(10, 30));
  drive("hwfet", trace);
  trace.hold(draws.whole(10, 30));
  drive("udds", trace);
  trace.hold(draws.whole(10, 30));
  trace.ramp(draws.happens(0.5) ? 104.6 : 88.5, 0.8);  // 65 or 55 mile/h
  trace.hold(60.0 * draws.whole(10, 45));
  trace.ramp(0.0, 1.0);
}

/// Half an hour and more at a few speeds, in a drawn order.
void constant_speeds(Draws& draws, SpeedTrace& trace) {
  std::vector<double> speeds{50.0, 80.0, 5.0 * draws.whole(22, 26)};
  if (draws.happens(0.5)) speeds.push_back(100.0);
  draws.shuffle(speeds);
  const double rate_m_s2 = draws.uniform(0.4, 1.2);
  for (const double speed_km_h : speeds) {
    trace.ramp(speed_km_h, rate_m_s2);
    trace.hold(60.0 * draws.whole(19, 27));
  }
  trace.ramp(0.0, rate_m_s2);
}

/// Highway and city by turns with constant speeds between.
void mixed(Draws& draws, SpeedTrace& trace) {
  trace.ramp(80.0, draws.uniform(0.5, 1.0));
  trace.hold(60.0 * draws.whole(15, 25));
  trace.ramp(0.0, 1.2);
  trace.hold(draws.whole(20, 60));
  drive(draws.happens(0.5) ? "udds" : "hwfet", trace);
  trace.ramp(5.0 * draws.whole(23, 26), draws.uniform(0.6, 1.2));
  trace.hold(60.0 * draws.whole(10, 18));
  trace.ramp(0.0, 1.2);
  trace.hold(draws.whole(20, 60));
  drive("udds", trace);
}

const std::vector<CampaignKind> kCampaigns{
    {"certification",
     {{"multi-cycle", "day-1"},
      {"multi-cycle", "day-1", 0, 15},
      {"constant speeds", "day-2"},
      {"mixed", "day-2", 250, 40}}},
    {"cold chamber",
     {{"multi-cycle", "day-1"}, {"multi-cycle", "day-2", 0, 0, -5}, {"constant speeds", "day-3", 0, 0, 35}}},
    {"research",
     {{"constant speeds", "day-1"},
      {"mixed", "day-1", 0, 30, 0, 1.15},
      {"constant speeds", "day-2", 240},
      {"multi-cycle", "day-2", 0, 90, 0, 0.85},
      {"mixed", "day-3", 0, 0, 8}}},
    {"developer",
     {{"mixed", "day-1"},
      {"multi-cycle", "day-1", 0, 60, 0, 1.2},
      {"constant speeds", "day-2", 310},
      {"mixed", "day-2", 0, 20}}}};

/// Force of the wheel on the roller at each row: its share of what moves the vehicle, or of its friction brakes.
std::vector<double> find_longitudinal_N(const std::vector<double>& speeds_m_s, double load_N,
                                        const Specimen& specimen) {
  const double mass_kg = specimen.tires * load_N / kStandardGravity_m_s2;
  std::vector<double> forces_N(speeds_m_s.size(), 0.0);
  for (std::size_t i = 1; i + 1 < speeds_m_s.size(); ++i) {
    const double v = speeds_m_s[i];
    if (v <= 0.0) continue;
    const double acceleration_m_s2 = 0.5 * (speeds_m_s[i + 1] - speeds_m_s[i - 1]);
    // Assumed: 1.2 % of the weight, 1.2 kg/m3 of air, 3.5 % of the mass for what turns.
    const double road_N = 0.012 * mass_kg * kStandardGravity_m_s2 +
                          0.6 * specimen.base[static_cast<std::size_t>(Base::kDragArea)].nominal * v * v;
    const double demand_N = 1.035 * mass_kg * acceleration_m_s2 + road_N;
    const double force_N = demand_N * (demand_N > 0.0 ? specimen.drive_share : specimen.brake_share);
    forces_N[i] = std::round(10.0 * force_N) / 10.0;
  }
  return forces_N;
}

std::vector<Leg> make_legs(const SpeedTrace& trace, double load_N, const Specimen& specimen) {
  const std::vector<double>& speeds = trace.speeds_m_s();
  const std::vector<double> forces_N = find_longitudinal_N(speeds, load_N, specimen);
  std::vector<Leg> legs;
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
    Leg leg{static_cast<double>(i), 1.0, speeds[i], speeds[i + 1], load_N};
    leg.start_longitudinal_N = forces_N[i];
    leg.end_longitudinal_N = forces_N[i + 1];
    legs.push_back(leg);
  }
  return legs;
}

std::vector<Leg> draw_legs(Draws& draws, const std::string& kind, double load_N, const Specimen& specimen) {
  SpeedTrace trace;
  trace.hold(draws.whole(5, 20));
  if (kind == "multi-cycle") {
    multi_cycle(draws, trace);
  } else if (kind == "constant speeds") {
    constant_speeds(draws, trace);
  } else if (kind == "mixed") {
    mixed(draws, trace);
  } else {
    throw std::logic_error("unknown kind of run: " + kind);
  }
  trace.hold(std::max(5.0, 3600.0 - trace.now_s()));
  return make_legs(trace, load_N, specimen);
}

Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) {
  constexpr Cooling kCooling{12.0, 20.0, 45.0};  // Assumed
  Draws draws(order.seed, "campaign");
  const CampaignKind& kind = draws.pick(kCampaigns);
  const double load_N = 50.0 * draws.whole(88, 112);
  return draw_runs(order, kind, kCooling, specimen, [&](Draws& own, const RunKind& what) {
    return draw_legs(own, what.kind, std::round(load_N * what.payload / 50.0) * 50.0, specimen);
  });
}

void draw_own(std::uint64_t seed, Specimen& specimen) {
  Draws draws(seed, "specimen/roller");
  specimen.drum_diameter_m = draws.happens(0.7) ? 1.2 : 1.2192;  // 1.2192 m: the 48 inch roller
  specimen.drum_inertia_kg_m2 = round_to(draws.uniform(90.0, 150.0), 3);
}

std::string write_file(const Specimen& specimen) {
  return rig::write_file(specimen, 1, rig::write_drum("roller", specimen));
}

double calc_moving_mass_kg(const Specimen&, double, double) { return 0.0; }  // the rig compensates it

// Assumed: a loss is the difference of two torques, so it is noisier than a drum's torque.
const Machine machine{
    "dyno",
    "rig.toml",
    Measured::kWheel,
    false,
    false,
    true,
    {columns::kTime,
     columns::kSpeed,
     columns::kLoad,
     {"longitudinal_force_N", &RunRecord::longitudinal_N, "{:.9g}"},
     columns::kAmbient},
    {{"loss_force_N", "torque", {0.6, 0.25, 60.0, 1.0, 0.0}}, columns::kLiner, columns::kPressure},
    {{"dyno_multi_cycle", 6, "multi-cycle"}, {"dyno_constant_speed", 6, "constant speeds"}, {"dyno_mixed", 6, ""}},
    rig::gives,
    rig::write_set_keys,
    write_file,
    draw_own,
    draw_campaign,
    rig::calc_drum_factor,
    find_unit_lever,
    calc_moving_mass_kg};

}  // namespace rollrig::generator::dyno
