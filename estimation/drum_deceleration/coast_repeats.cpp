#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "estimation/drum_deceleration/coast_doubts.h"
#include "estimation/run_checks/recording_repeats.h"

namespace rollrig::estimation {
namespace {

/// Rows of a body as recorded, from the start of its coast to its end.
RecordedSeries take_coast_rows(const CoastSet& set, const CoastAnalysis& analysis) {
  constexpr double kMargin_s = 0.5;  // rows of the coast stand half a period before those recorded
  const CoastRun& run = set.runs[analysis.run];
  const CoastSeries& recorded = analysis.body == CoastBody::kDrum ? *run.drum : *run.wheel;
  RecordedSeries rows;
  for (std::size_t i = 0; i < recorded.time_s.size(); ++i) {
    const double time_s = recorded.time_s[i];
    if (time_s < analysis.coast.start_s || time_s > analysis.coast.time_s.back() + kMargin_s) continue;
    rows.time_s.push_back(time_s);
    rows.speed_m_s.push_back(recorded.speed_m_s[i]);
  }
  return rows;
}

/// Labels in which two runs differ.
std::string list_differences(const CoastRun& a, const CoastRun& b) {
  std::string text;
  const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (a.state != b.state) add("state");
  if (a.state == CoastState::kLoaded && b.state == CoastState::kLoaded) {
    if (!is_same_pressure(a.pressure_Pa, b.pressure_Pa)) add("pressure");
    if (!is_same_load(a.load_N, b.load_N)) add("load");
  }
  if (a.direction != b.direction) add("direction");
  return text;
}

void remove_rows(double from_s, double to_s, Coast& coast) {
  Coast kept = coast;
  kept.time_s.clear();
  kept.speed_m_s.clear();
  kept.smooth_m_s.clear();
  for (std::size_t i = 0; i < coast.time_s.size(); ++i) {
    if (coast.time_s[i] >= from_s && coast.time_s[i] <= to_s) continue;
    kept.time_s.push_back(coast.time_s[i]);
    kept.speed_m_s.push_back(coast.speed_m_s[i]);
    kept.smooth_m_s.push_back(coast.smooth_m_s[i]);
  }
  coast = std::move(kept);
}

/// Whether the set names one file in both runs, be it in two ways ("a.csv", "./a.csv").
bool is_same_file(const CoastRun& a, const CoastRun& b) {
  const auto normal = [](const CoastRun& run) { return std::filesystem::path(run.file).lexically_normal(); };
  return a.id == b.id || (!a.file.empty() && normal(a) == normal(b));
}

RunDoubt describe_repeat(const CoastSet& set, std::size_t first, std::size_t second, const RecordedSeries& rows,
                         const SeriesRepeat& repeat, bool whole) {
  const CoastRun& a = set.runs[first];
  const CoastRun& b = set.runs[second];
  RunDoubt doubt{
      DoubtKind::kRepeat, {a.id, b.id}, whole ? "the same recording" : "the same recording in part", 0.0, ""};
  const bool same_file = is_same_file(a, b);
  doubt.text = same_file ? fmt::format("the file {} is given twice", a.id)
                         : fmt::format("{} and {} are the same recording", a.id, b.id);
  doubt.text += whole ? ": it is counted once"
                      : fmt::format(" from {:.1f} to {:.1f} km/h: this part is counted once",
                                    3.6 * rows.speed_m_s[repeat.begin], 3.6 * rows.speed_m_s[repeat.end - 1]);
  const std::string differences = list_differences(a, b);
  if (!differences.empty()) {
    doubt.text += fmt::format(", as {}. The two differ in {}: in one of them that is wrong",
                              same_file ? "it is given first" : a.id, differences);
  }
  return doubt;
}

}  // namespace

std::vector<RunDoubt> leave_out_repeated_coasts(const CoastSet& set, std::vector<CoastAnalysis>& analyses) {
  constexpr double kWhole = 0.9;
  constexpr std::size_t kFewestRows = 20;
  std::vector<RecordedSeries> series;
  for (const CoastAnalysis& analysis : analyses) series.push_back(take_coast_rows(set, analysis));
  std::vector<RunDoubt> doubts;
  std::set<std::size_t> gone;                            // runs
  std::set<std::pair<std::size_t, std::size_t>> judged;  // pairs of runs
  for (const SeriesRepeat& repeat : find_series_repeats(series)) {
    const std::size_t first = analyses[repeat.first].run;
    const std::size_t second = analyses[repeat.second].run;
    if (first == second || gone.count(first) != 0 || gone.count(second) != 0) continue;
    const RecordedSeries& rows = series[repeat.second];
    const bool whole =
        static_cast<double>(repeat.end - repeat.begin) >= kWhole * static_cast<double>(rows.time_s.size());
    if (judged.emplace(first, second).second) {
      doubts.push_back(describe_repeat(set, first, second, rows, repeat, whole));
    }
    if (whole) {
      gone.insert(second);
    } else {
      remove_rows(rows.time_s[repeat.begin] - 1.0, rows.time_s[repeat.end - 1], analyses[repeat.second].coast);
    }
  }
  const auto is_out = [&](const CoastAnalysis& analysis) {
    return gone.count(analysis.run) != 0 || analysis.coast.time_s.size() < kFewestRows;
  };
  analyses.erase(std::remove_if(analyses.begin(), analyses.end(), is_out), analyses.end());
  return doubts;
}

}  // namespace rollrig::estimation
