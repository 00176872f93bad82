#include "tests/support/coastdown_study.h"

#include <cmath>
#include <string>

#include "sim/core/csv.h"
#include "sim/core/random.h"
#include "sim/core/units.h"

namespace rollrig::tests {
namespace {

struct RunDraw {
  int heading = 0;
  double extra_N = 0.0;
  double wind_m_s = 0.0;  // against the vehicle
  double rolling = 1.0;
};

double force_N(const CoastdownStudy& study, const RunDraw& draw, double v) {
  const double k = draw.rolling / (1.0 + study.rolling_fall_per_K * (study.ambient_K - 293.15));
  const double q = study.ambient_pressure_Pa / 98.21e3 * 293.15 / study.ambient_K;
  const double air = v + draw.wind_m_s;
  return k * (study.load.A_N + study.load.B_N_s_per_m * v) + q * study.load.C_N_s2_per_m2 * air * std::abs(air) +
         draw.extra_N + draw.heading * study.mass_kg * kStandardGravity_m_s2 * study.slope;
}

estimation::CoastdownRun simulate_run(const CoastdownStudy& study, const RunDraw& draw, RandomStream& random) {
  estimation::CoastdownRun run;
  run.heading = draw.heading;
  const double h = study.interval_s;
  double v = study.from_km_h / 3.6;
  for (int i = 0; v > study.to_km_h / 3.6 && v > 0.0; ++i) {
    double measured = v + (study.noise_sd_m_s > 0.0 ? study.noise_sd_m_s * random.normal() : 0.0);
    if (study.resolution_km_h > 0.0)
      measured = std::round(3.6 * measured / study.resolution_km_h) * study.resolution_km_h / 3.6;
    run.time_s.push_back(i * h);
    run.speed_m_s.push_back(std::max(measured, 0.0));
    const double gust = study.gust_N_sqrt_s > 0.0 ? study.gust_N_sqrt_s / std::sqrt(h) * random.normal() : 0.0;
    const auto rate = [&](double speed) { return -(force_N(study, draw, speed) + gust) / study.effective_mass_kg; };
    const double k1 = rate(v);
    const double k2 = rate(v + 0.5 * h * k1);
    const double k3 = rate(v + 0.5 * h * k2);
    const double k4 = rate(v + h * k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return run;
}

}  // namespace

estimation::CoastdownData simulate_coastdowns(const CoastdownStudy& study, std::uint64_t seed) {
  estimation::CoastdownData data;
  RandomStream random(seed, "coastdown");
  const int runs = 2 * study.pairs;
  for (int i = 0; i < runs; ++i) {
    RunDraw draw;
    draw.heading = i % 2 == 0 ? +1 : -1;
    draw.extra_N = study.run_force_sd_N * random.normal();
    draw.wind_m_s = draw.heading * study.wind_m_s + study.run_wind_sd_m_s * random.normal();
    draw.rolling = 1.0 + study.drift * i / std::max(1, runs - 1);
    data.runs.push_back(simulate_run(study, draw, random));
    data.runs.back().id = std::to_string(i + 1);
    data.runs.back().session = "day";
    data.runs.back().start_s = 300.0 * i;
  }
  return data;
}

std::string write_coastdown_csv(const estimation::CoastdownData& data) {
  CsvWriter csv({"time_s", "speed_km_h", "run", "heading", "ambient_degC"});
  for (const auto& run : data.runs) {
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      csv.add_row(run.time_s[i], 3.6 * run.speed_m_s[i], run.id, run.heading > 0 ? "+" : "-", 20.0);
    }
  }
  return csv.take();
}

estimation::CoastdownData cut_into_bins(const estimation::CoastdownData& traces, double width_km_h) {
  estimation::CoastdownData data = traces;
  for (estimation::CoastdownRun& run : data.runs) {
    const double width = width_km_h / 3.6;
    double edge = std::floor(run.speed_m_s.front() / width) * width;
    double last_s = -1.0;
    for (std::size_t i = 1; i < run.speed_m_s.size(); ++i) {
      if (run.speed_m_s[i] > edge || edge <= 0.0) continue;
      const double share = (run.speed_m_s[i - 1] - edge) / (run.speed_m_s[i - 1] - run.speed_m_s[i]);
      const double now_s = run.time_s[i - 1] + share * (run.time_s[i] - run.time_s[i - 1]);
      if (last_s >= 0.0) run.bins.push_back({edge + width, edge, now_s - last_s});
      last_s = now_s;
      edge -= width;
    }
    run.time_s.clear();
    run.speed_m_s.clear();
  }
  return data;
}

}  // namespace rollrig::tests
