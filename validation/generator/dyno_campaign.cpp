/// What is driven on a vehicle dynamometer: published cycles, constant speeds, and both mixed, cold and after rests.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/generator/campaign.h"
#include "validation/generator/cycles.h"
#include "validation/generator/speed_trace.h"

namespace blind {
namespace {

constexpr double kGravity_m_s2 = 9.80665;

/// UDDS, highway, UDDS and a constant speed: half of a multi-cycle test.
void multi_cycle(Draws& draws, SpeedTrace& trace) {
  trace.cycle(cycle_km_h("udds"));
  trace.hold(draws.whole(10, 30));
  trace.cycle(cycle_km_h("hwfet"));
  trace.hold(draws.whole(10, 30));
  trace.cycle(cycle_km_h("udds"));
  trace.hold(draws.whole(10, 30));
  trace.ramp(draws.happens(0.5) ? 104.6 : 88.5, 0.8);  // 65 or 55 mile/h
  trace.hold(60.0 * draws.whole(10, 45));
  trace.ramp(0.0, 1.0);
}

/// Half an hour and more at a few speeds, in a drawn order.
void constant_speeds(Draws& draws, SpeedTrace& trace) {
  std::vector<double> speeds{50.0, 80.0, 5.0 * draws.whole(22, 26)};
  if (draws.happens(0.5)) speeds.push_back(100.0);
  for (std::size_t i = speeds.size() - 1; i > 0; --i) {
    std::swap(speeds[i], speeds[static_cast<std::size_t>(draws.whole(0, static_cast<int>(i)))]);
  }
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
  trace.cycle(cycle_km_h(draws.happens(0.5) ? "udds" : "hwfet"));
  trace.ramp(5.0 * draws.whole(23, 26), draws.uniform(0.6, 1.2));
  trace.hold(60.0 * draws.whole(10, 18));
  trace.ramp(0.0, 1.2);
  trace.hold(draws.whole(20, 60));
  trace.cycle(cycle_km_h("udds"));
}

struct RunKind {
  const char* kind;
  const char* session;
  double ambient_degC;     // of the chamber; 0: the usual one
  double rest_before_min;  // 0: soaked
  double pressure_kPa;     // 0: the usual one
  double payload;          // on the wheel's load
};

struct CampaignKind {
  const char* name;
  std::vector<RunKind> runs;
};

const std::vector<CampaignKind>& campaign_kinds() {
  static const std::vector<CampaignKind> kinds{{"certification",
                                                {{"multi-cycle", "day-1", 0, 0, 0, 1.0},
                                                 {"multi-cycle", "day-1", 0, 15, 0, 1.0},
                                                 {"constant speeds", "day-2", 0, 0, 0, 1.0},
                                                 {"mixed", "day-2", 0, 40, 250, 1.0}}},
                                               {"cold chamber",
                                                {{"multi-cycle", "day-1", 0, 0, 0, 1.0},
                                                 {"multi-cycle", "day-2", -5, 0, 0, 1.0},
                                                 {"constant speeds", "day-3", 35, 0, 0, 1.0}}},
                                               {"research",
                                                {{"constant speeds", "day-1", 0, 0, 0, 1.0},
                                                 {"mixed", "day-1", 0, 30, 0, 1.15},
                                                 {"constant speeds", "day-2", 0, 0, 240, 1.0},
                                                 {"multi-cycle", "day-2", 0, 90, 0, 0.85},
                                                 {"mixed", "day-3", 8, 0, 0, 1.0}}},
                                               {"developer",
                                                {{"mixed", "day-1", 0, 0, 0, 1.0},
                                                 {"multi-cycle", "day-1", 0, 60, 0, 1.2},
                                                 {"constant speeds", "day-2", 0, 0, 310, 1.0},
                                                 {"mixed", "day-2", 0, 20, 0, 1.0}}}};
  return kinds;
}

/// Force of the wheel on the roller at each row: its share of what moves the vehicle, or of its friction brakes.
std::vector<double> find_longitudinal_N(const std::vector<double>& speeds_m_s, double load_N,
                                        const Specimen& specimen) {
  const double mass_kg = specimen.tires * load_N / kGravity_m_s2;
  std::vector<double> forces_N(speeds_m_s.size(), 0.0);
  for (std::size_t i = 1; i + 1 < speeds_m_s.size(); ++i) {
    const double v = speeds_m_s[i];
    if (v <= 0.0) continue;
    const double acceleration_m_s2 = 0.5 * (speeds_m_s[i + 1] - speeds_m_s[i - 1]);
    // Assumed: 1.2 % of the weight and 1.2 kg/m3 of air.
    const double road_N = 0.012 * mass_kg * kGravity_m_s2 +
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
  if (kind == "multi-cycle") multi_cycle(draws, trace);
  if (kind == "constant speeds") constant_speeds(draws, trace);
  if (kind == "mixed") mixed(draws, trace);
  trace.hold(std::max(5.0, 3600.0 - trace.now_s()));
  return make_legs(trace, load_N, specimen);
}

std::string choose_kind(const RunKind& what, DynoRuns dyno_runs) {
  if (dyno_runs == DynoRuns::kMultiCycle) return "multi-cycle";
  return dyno_runs == DynoRuns::kConstantSpeeds ? "constant speeds" : what.kind;
}

}  // namespace

Campaign draw_dyno_campaign(std::uint64_t seed, const Specimen& specimen, int runs, DynoRuns dyno_runs) {
  Draws draws(seed, "campaign");
  const auto& kinds = campaign_kinds();
  const CampaignKind& kind = kinds[static_cast<std::size_t>(draws.whole(0, static_cast<int>(kinds.size()) - 1))];
  const double load_N = 50.0 * draws.whole(88, 112);
  Campaign campaign{kind.name, {}};
  for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(runs), kind.runs.size()); ++i) {
    const RunKind& what = kind.runs[i];
    Draws own(seed, fmt::format("run/{}", i));
    RunPlan run;
    const std::string run_kind = choose_kind(what, dyno_runs);
    run.id = fmt::format("{}-{}", i + 1, run_kind);
    std::replace(run.id.begin(), run.id.end(), ' ', '-');
    run.index = i;
    run.session = what.session;
    run.cold_pressure_kPa = what.pressure_kPa > 0.0 ? what.pressure_kPa : specimen.reference_pressure_kPa;
    run.air = draw_air(own, what.ambient_degC != 0.0 ? what.ambient_degC : specimen.ambient_degC);
    double warm_dK = 0.0;
    if (what.rest_before_min > 0.0) {
      run.rest_before_min = std::round(what.rest_before_min * own.uniform(0.7, 1.3));
      warm_dK = own.uniform(12.0, 20.0) * std::exp(-*run.rest_before_min / 45.0);  // Assumed: cools in an hour
    }
    run.initial_degC = std::round(10.0 * (run.air.at(0.0) + warm_dK)) / 10.0;
    run.legs = draw_legs(own, run_kind, std::round(load_N * what.payload / 50.0) * 50.0, specimen);
    campaign.runs.push_back(std::move(run));
  }
  return campaign;
}

}  // namespace blind
