#include "comparison/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rollrig::comparison {
namespace {

std::vector<std::string> list_phase_names(const OverlaidRun& run) {
  std::vector<std::string> names;
  for (const OverlayPhase& phase : run.phases) names.push_back(phase.name);
  return names;
}

bool have_same_phases(const std::vector<OverlaidRun>& runs) {
  return std::all_of(runs.begin(), runs.end(), [&runs](const OverlaidRun& run) {
    return list_phase_names(run) == list_phase_names(runs.front());
  });
}

/// Phases one after the other, each as long as the longest, from the start of the reference on.
std::vector<OverlayPhase> join_phases(const std::vector<OverlaidRun>& runs) {
  std::vector<OverlayPhase> joined;
  double at_s = runs.front().phases.empty() ? 0.0 : runs.front().phases.front().start_s;
  for (std::size_t p = 0; p < runs.front().phases.size(); ++p) {
    double length_s = 0.0;
    for (const OverlaidRun& run : runs) length_s = std::max(length_s, run.phases[p].end_s - run.phases[p].start_s);
    joined.push_back({runs.front().phases[p].name, at_s, at_s + length_s});
    at_s += length_s;
  }
  return joined;
}

/// Of each row its time on the common axis.
std::vector<double> align_times(const OverlaidRun& run, const std::vector<OverlayPhase>& joined) {
  std::vector<double> times;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const std::size_t phase = run.phase[row];
    times.push_back(run.time_s[row] - run.phases[phase].start_s + joined[phase].start_s);
  }
  return times;
}

/// Start of the first phase of the reference that all have, in each; none where there is no such phase.
std::optional<std::vector<double>> find_common_start(const std::vector<OverlaidRun>& runs) {
  for (const OverlayPhase& phase : runs.front().phases) {
    std::vector<double> starts;
    for (const OverlaidRun& run : runs) {
      const auto found = std::find_if(run.phases.begin(), run.phases.end(),
                                      [&phase](const OverlayPhase& other) { return other.name == phase.name; });
      if (found != run.phases.end()) starts.push_back(found->start_s);
    }
    if (starts.size() == runs.size()) return starts;
  }
  return std::nullopt;
}

std::vector<double> shift(std::vector<double> times, double by_s) {
  for (double& time_s : times) time_s += by_s;
  return times;
}

/// A line with a gap after each phase that is shorter than that of the axis.
OverlayLine make_line(const OverlaidRun& run, const std::vector<double>& times, const std::vector<double>& values,
                      const std::vector<OverlayPhase>& joined) {
  constexpr double kSame_s = 1e-6;
  OverlayLine line;
  for (std::size_t row = 0; row < times.size(); ++row) {
    line.time_s.push_back(times[row]);
    line.values.push_back(values[row]);
    if (joined.empty() || row + 1 == times.size() || run.phase[row + 1] == run.phase[row]) continue;
    const std::size_t phase = run.phase[row];
    const double lacking_s =
        joined[phase].end_s - joined[phase].start_s - run.phases[phase].end_s + run.phases[phase].start_s;
    if (lacking_s < kSame_s) continue;
    line.time_s.push_back(0.5 * (times[row] + times[row + 1]));
    line.values.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  return line;
}

const std::vector<double>* find_channel(const OverlaidRun& run, const std::string& name) {
  for (const auto& [channel, values] : run.channels) {
    if (channel == name) return &values;
  }
  return nullptr;
}

/// A minute before the reference rolls: a soak of hours would fill the axis.
double find_view_start(const OverlaidRun& run, const std::vector<double>& times) {
  constexpr double kRolls_km_h = 0.2;
  constexpr double kBefore_s = 60.0;
  if (times.empty()) return 0.0;
  const std::vector<double>* speed_km_h = find_channel(run, "speed_km_h");
  for (std::size_t row = 0; speed_km_h != nullptr && row < times.size(); ++row) {
    if (std::abs((*speed_km_h)[row]) > kRolls_km_h) return std::max(times.front(), times[row] - kBefore_s);
  }
  return times.front();
}

}  // namespace

Overlay overlay_runs(const std::vector<OverlaidRun>& runs, const std::vector<std::string>& names,
                     const std::string& title, std::vector<std::string>& warnings) {
  Overlay overlay;
  overlay.title = title;
  std::vector<std::vector<double>> times;
  const bool is_aligned = have_same_phases(runs);
  if (is_aligned) overlay.phases = join_phases(runs);
  const std::optional<std::vector<double>> starts = is_aligned ? std::nullopt : find_common_start(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    times.push_back(is_aligned           ? align_times(runs[i], overlay.phases)
                    : starts.has_value() ? shift(runs[i].time_s, starts->front() - (*starts)[i])
                                         : runs[i].time_s);
  }
  if (!is_aligned) {
    overlay.phases = runs.front().phases;
    warnings.push_back(
        fmt::format("{}the phases differ: over time, only their beginnings coincide. Phases shown are those of {}",
                    title.empty() ? "" : title + ": ", names.front()));
  }
  overlay.view_start_s = find_view_start(runs.front(), times.front());
  for (const auto& [channel, values] : runs.front().channels) {
    OverlayPanel panel{channel, {}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::vector<double>* own = find_channel(runs[i], channel);
      if (own == nullptr) break;
      panel.lines.push_back(
          make_line(runs[i], times[i], *own, is_aligned ? overlay.phases : std::vector<OverlayPhase>()));
    }
    if (panel.lines.size() == runs.size()) overlay.panels.push_back(std::move(panel));
  }
  return overlay;
}

}  // namespace rollrig::comparison
