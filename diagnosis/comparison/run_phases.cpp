#include "diagnosis/comparison/run_phases.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kShortest_s = 30.0;     // Assumed: a change of speed that is a phase of its own
constexpr double kStandstill_m_s = 0.3;  // Assumed

enum class Motion { kStandstill, kSteady, kChanging };

Motion motion_at(const measurements::MeasuredRun& run, std::size_t row) {
  if (std::abs(measurements::find_acceleration(run, row)) > measurements::kSteadyAcceleration_m_s2) {
    return Motion::kChanging;
  }
  return run.column(models::quantities::kSpeed)[row] < kStandstill_m_s ? Motion::kStandstill : Motion::kSteady;
}

struct Stretch {
  Motion motion;
  bool load_begins;  // a new load, so that it cannot be one with the stretch before
  std::size_t first, last;
};

std::vector<Stretch> find_stretches(const measurements::MeasuredRun& run) {
  std::vector<Stretch> stretches;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const Motion motion = motion_at(run, row);
    const bool load_begins = measurements::is_load_change(run, row);
    if (!stretches.empty() && !load_begins && stretches.back().motion == motion) {
      stretches.back().last = row + 1;
    } else {
      stretches.push_back({motion, load_begins, row, row + 1});
    }
  }
  return stretches;
}

/// Joins short stretches with the one that follows at the same load, or else with the one before.
std::vector<Stretch> join_short(const measurements::MeasuredRun& run, std::vector<Stretch> stretches) {
  const auto duration_s = [&run](const Stretch& at) {
    const std::size_t end = std::min(at.last, run.time_s.size() - 1);
    return run.time_s[end] - run.time_s[at.first];
  };
  std::vector<Stretch> joined;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    Stretch& at = stretches[i];
    const bool is_short = duration_s(at) < kShortest_s;
    if (is_short && i + 1 < stretches.size() && !stretches[i + 1].load_begins) {
      stretches[i + 1].first = at.first;
      stretches[i + 1].load_begins = at.load_begins;
    } else if (!joined.empty() &&
               (is_short || (!at.load_begins && joined.back().motion == at.motion && at.motion == Motion::kChanging))) {
      joined.back().last = at.last;
    } else {
      joined.push_back(at);
    }
  }
  return joined;
}

double mean_of(const std::vector<double>& values, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

}  // namespace

std::vector<RunPhase> find_phases(const measurements::MeasuredRun& run, double skim_limit_N) {
  std::vector<RunPhase> phases;
  std::map<std::string, int> seen;
  for (const Stretch& at : join_short(run, find_stretches(run))) {
    const double load_N = mean_of(run.column(models::quantities::kLoad), at.first, at.last);
    const double last_speed_km_h = 3.6 * run.column(models::quantities::kSpeed)[at.last - 1];
    std::string name = fmt::format("{:.0f} km/h {:.1f} kN", last_speed_km_h, load_N / 1e3);
    const bool numbered = load_N <= skim_limit_N || at.motion != Motion::kSteady;
    if (load_N <= skim_limit_N) name = "skim";
    if (at.motion == Motion::kChanging) name = "speed change";
    if (at.motion == Motion::kStandstill) name = "standstill";
    const int count = ++seen[name];
    if (numbered || count > 1)
      name += fmt::format(" {}", numbered ? fmt::format("{}", count) : fmt::format("({})", count));
    phases.push_back({name, at.first, at.last});
  }
  return phases;
}

}  // namespace rollrig::diagnosis
