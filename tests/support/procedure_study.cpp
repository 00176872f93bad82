#include "tests/support/procedure_study.h"

#include <algorithm>
#include <cmath>

#include "sim/core/csv.h"
#include "sim/core/random.h"
#include "sim/core/units.h"

namespace rollrig::tests {
namespace {

struct Sensors {
  double ambient_K = 0.0;
  double pressure_Pa = 0.0;
};

estimation::CoastdownRun simulate_one(const ProcedureStudy& study, int heading, double from_km_h, double to_km_h,
                                      const Sensors& off, RandomStream& random) {
  constexpr double kMemory_s = 4.0;
  estimation::CoastdownRun run;
  run.heading = heading;
  const double step_s = study.interval_s;
  const double extra_N = study.run_force_sd_N * random.normal();
  const double rolling = 1.0 / (1.0 + 8.6e-3 * (study.ambient_K - 293.15));
  const double density = study.ambient_pressure_Pa / study.reference_pressure_Pa * 293.15 / study.ambient_K;
  double gust_m_s = study.gust_sd_m_s * random.normal();
  double v = from_km_h / 3.6;
  for (int i = 0; v > to_km_h / 3.6; ++i) {
    const double against_m_s = heading * study.wind_m_s + gust_m_s;
    const double across_m_s = heading * study.crosswind_m_s;
    const auto force_N = [&](double speed) {
      const double along = speed + against_m_s;
      const double yaw = std::atan2(across_m_s, along);
      const double air2 = along * along + across_m_s * across_m_s;
      return rolling * (study.load.A_N + study.load.B_N_s_per_m * speed) +
             density * study.load.C_N_s2_per_m2 * (1.0 + study.yaw_drag_per_rad2 * yaw * yaw) * air2 + extra_N +
             heading * study.mass_kg * kStandardGravity_m_s2 * study.slope;
    };
    run.time_s.push_back(i * step_s);
    run.speed_m_s.push_back(v + study.noise_sd_m_s * random.normal());
    run.conditions.ambient_K.push_back(study.ambient_K + off.ambient_K);
    run.conditions.ambient_pressure_Pa.push_back(study.ambient_pressure_Pa + off.pressure_Pa);
    if (study.on_board) {
      const double along = v + against_m_s;
      run.conditions.air_speed_m_s.push_back(
          std::max(0.0, std::hypot(along, across_m_s) + study.air_noise_m_s * random.normal()));
      run.conditions.yaw_rad.push_back(std::atan2(across_m_s, along));
    } else {
      run.conditions.wind_m_s.push_back(study.wind_m_s);
      run.conditions.crosswind_m_s.push_back(study.crosswind_m_s);
    }
    if (study.slope_known) run.conditions.slope.push_back(study.slope);
    const double effective_kg = study.mass_kg + study.rotating_mass_kg;
    const double half = v - 0.5 * step_s * force_N(v) / effective_kg;
    v -= step_s * force_N(half) / effective_kg;
    const double keep = std::exp(-step_s / kMemory_s);
    gust_m_s = keep * gust_m_s + study.gust_sd_m_s * std::sqrt(1.0 - keep * keep) * random.normal();
  }
  return run;
}

}  // namespace

SimulatedProcedure simulate_procedure(const ProcedureStudy& study, std::uint64_t seed) {
  RandomStream random(seed, "procedure");
  SimulatedProcedure simulated;
  simulated.file.is_trace = true;
  simulated.mass_kg = study.mass_kg;
  Sensors off;
  const auto within = [&random](double half_width) { return half_width * (2.0 * random.uniform() - 1.0); };
  if (study.sensors_off) {
    off = {within(1.0), within(300.0)};
    simulated.mass_kg += within(10.0);
  }
  struct Stretch {
    double from_km_h, to_km_h;
  };
  std::vector<Stretch> parts{{study.from_km_h, study.to_km_h}};
  if (study.split_km_h > 0.0) {
    parts = {{study.from_km_h, study.split_km_h}, {study.split_km_h + study.split_overlap_km_h, study.to_km_h}};
  }
  auto& runs = simulated.file.data.runs;
  for (const Stretch& part : parts) {
    for (int i = 0; i < 2 * study.pairs; ++i) {
      const double later_km_h = study.from_scatter_km_h > 0.0 ? within(study.from_scatter_km_h) : 0.0;
      runs.push_back(
          simulate_one(study, i % 2 == 0 ? 1 : -1, part.from_km_h + later_km_h, part.to_km_h, off, random));
      runs.back().id = std::to_string(runs.size());
      runs.back().session = "day";
    }
  }
  return simulated;
}

std::string write_procedure_csv(const estimation::CoastdownData& data) {
  const estimation::CoastdownConditions& has = data.runs.front().conditions;
  std::vector<std::string> columns{"time_s", "speed_km_h", "run", "heading", "ambient_degC", "ambient_pressure_kPa"};
  if (!has.wind_m_s.empty()) columns.insert(columns.end(), {"wind_m_s", "crosswind_m_s"});
  if (!has.air_speed_m_s.empty()) columns.insert(columns.end(), {"air_speed_km_h", "yaw_deg"});
  if (!has.slope.empty()) columns.push_back("slope");
  CsvWriter csv(columns);
  for (const estimation::CoastdownRun& run : data.runs) {
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      csv.add(run.time_s[i]);
      csv.add(3.6 * run.speed_m_s[i]);
      csv.add(run.id);
      csv.add(std::string(run.heading > 0 ? "+" : "-"));
      csv.add(run.conditions.ambient_K[i] - kZeroCelsius_K);
      csv.add(1e-3 * run.conditions.ambient_pressure_Pa[i]);
      if (!has.wind_m_s.empty()) {
        csv.add(run.conditions.wind_m_s[i]);
        csv.add(run.conditions.crosswind_m_s[i]);
      }
      if (!has.air_speed_m_s.empty()) {
        csv.add(3.6 * run.conditions.air_speed_m_s[i]);
        csv.add(run.conditions.yaw_rad[i] / 0.017453292519943295);
      }
      if (!has.slope.empty()) csv.add(run.conditions.slope[i]);
      csv.end_row();
    }
  }
  return csv.take();
}

}  // namespace rollrig::tests
