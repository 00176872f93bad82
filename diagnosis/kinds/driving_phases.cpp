#include "diagnosis/kinds/kinds.h"

#include <fmt/format.h>

#include <map>

#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kWindow_s = 120.0;
constexpr double kShortestDrive_s = 240.0;

const char* name_of_speed(double mean_km_h) {
  if (mean_km_h < 1.0) return "standstill";
  if (mean_km_h < 50.0) return "city";
  return mean_km_h < 90.0 ? "country" : "motorway";
}

struct Window {
  std::size_t first = 0;
  std::size_t last = 0;  // one past its last row
  bool load_begins = false;
  std::string name = {};
};

/// Windows of two minutes, and of what is left before a change of load.
std::vector<Window> cut_windows(const measurements::MeasuredRun& run) {
  const bool has_load = run.has(models::quantities::kLoad);
  std::vector<Window> windows{{0, 0}};
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const bool load_begins = has_load && measurements::is_load_change(run, row);
    const bool is_full = run.time_s[row] - run.time_s[windows.back().first] >= kWindow_s;
    if (load_begins || is_full) windows.push_back({row, row, load_begins});
    windows.back().last = row + 1;
  }
  return windows;
}

double find_mean_km_h(const measurements::MeasuredRun& run, const Window& window) {
  double sum_m_s = 0.0;
  for (std::size_t row = window.first; row < window.last; ++row) sum_m_s += run.column(models::quantities::kSpeed)[row];
  return 3.6 * sum_m_s / static_cast<double>(window.last - window.first);
}

/// Joins neighbors of one name and load.
std::vector<Window> join_equal(const std::vector<Window>& windows) {
  std::vector<Window> joined;
  for (const Window& window : windows) {
    if (!joined.empty() && !window.load_begins && joined.back().name == window.name) {
      joined.back().last = window.last;
    } else {
      joined.push_back(window);
    }
  }
  return joined;
}

/// Gives short ones to the one before them, at the start of a load to the next.
std::vector<Window> join_short_drives(const measurements::MeasuredRun& run, std::vector<Window> windows) {
  std::vector<Window> joined;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Window& at = windows[i];
    const bool is_short = run.time_s[at.last - 1] - run.time_s[at.first] < kShortestDrive_s;
    if (is_short && !at.load_begins && !joined.empty()) {
      joined.back().last = at.last;
    } else if (is_short && i + 1 < windows.size() && !windows[i + 1].load_begins) {
      windows[i + 1].first = at.first;
      windows[i + 1].load_begins = at.load_begins;
    } else {
      joined.push_back(at);
    }
  }
  return join_equal(joined);
}

}  // namespace

std::vector<RunPhase> find_driving_phases(const measurements::MeasuredRun& run) {
  std::vector<Window> windows = cut_windows(run);
  for (Window& window : windows) window.name = name_of_speed(find_mean_km_h(run, window));
  std::vector<RunPhase> phases;
  std::map<std::string, int> seen;
  for (const Window& window : join_short_drives(run, join_equal(windows))) {
    phases.push_back({fmt::format("{} {}", window.name, ++seen[window.name]), window.first, window.last});
  }
  return phases;
}

}  // namespace rollrig::diagnosis
