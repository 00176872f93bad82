#include "estimation/road_load/coastdown_repeats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "estimation/run_checks/recording_repeats.h"
#include "estimation/run_checks/robust_statistics.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr double kSameLabel_m_s = 0.2 / 3.6;  // Assumed: two labels of one bin, in other units or rounded

/// Part of a run that is a part of another one: rows of a trace, or bins.
struct SharedPart {
  std::size_t first = 0;
  std::size_t second = 0;
  std::size_t first_size = 0;
  std::size_t begin = 0;  // of the second
  std::size_t end = 0;
};

std::size_t size_of(const CoastdownRun& run) { return run.bins.empty() ? run.time_s.size() : run.bins.size(); }

/// Keeps rows [begin, end) of what has a value a row.
template <class T>
void keep_rows(std::size_t begin, std::size_t end, std::vector<T>& values) {
  if (values.empty()) return;
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(end), values.end());
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(begin));
}

void keep_part(std::size_t begin, std::size_t end, CoastdownRun& run) {
  keep_rows(begin, end, run.time_s);
  keep_rows(begin, end, run.speed_m_s);
  keep_rows(begin, end, run.bins);
  keep_rows(begin, end, run.conditions.ambient_K);
  keep_rows(begin, end, run.conditions.ambient_pressure_Pa);
  keep_rows(begin, end, run.conditions.wind_m_s);
  keep_rows(begin, end, run.conditions.crosswind_m_s);
  keep_rows(begin, end, run.conditions.slope);
  run.total_s.reset();  // they were of the whole run
  run.distance_m.reset();
}

/// Scatter of the times through bins along a run, relative: from bin to bin about the level of the run, since runs of
/// one level agree more often than by chance.
double find_bin_scatter(const CoastdownData& data) {
  constexpr double kUnknown = 0.02;  // Assumed, where too few values tell
  constexpr std::size_t kFewest = 10;
  std::map<std::array<long, 3>, std::vector<double>> times;
  const auto key = [](const CoastdownRun& run, const SpeedBin& bin) {
    return std::array<long, 3>{std::lround(bin.high_m_s / kSameLabel_m_s), std::lround(bin.low_m_s / kSameLabel_m_s),
                               run.heading};
  };
  for (const CoastdownRun& run : data.runs) {
    for (const SpeedBin& bin : run.bins) times[key(run, bin)].push_back(bin.duration_s);
  }
  std::vector<double> rest;
  for (const CoastdownRun& run : data.runs) {
    std::vector<double> deviations;
    for (const SpeedBin& bin : run.bins) {
      const std::vector<double>& of_bin = times[key(run, bin)];
      if (of_bin.size() > 2) deviations.push_back(bin.duration_s / calc_median(of_bin) - 1.0);
    }
    const double level = calc_median(deviations);
    if (deviations.size() < 3) continue;
    for (const double deviation : deviations) rest.push_back(deviation - level);
  }
  const double scatter = rest.size() < kFewest ? 0.0 : calc_mad_sd(rest);
  return scatter > 0.0 ? scatter : kUnknown;
}

std::vector<double> list_durations_s(const CoastdownRun& run) {
  std::vector<double> durations;
  for (const SpeedBin& bin : run.bins) durations.push_back(bin.duration_s);
  return durations;
}

/// Step in which the times of a run were written: that of its session, unless its own is much coarser. The few times of
/// one run are multiples of a coarser step now and then.
double find_step_s(const CoastdownData& data, const CoastdownRun& run) {
  constexpr double kCoarser = 2.5;
  std::vector<double> all;
  for (const CoastdownRun& other : data.runs) {
    if (other.session != run.session) continue;
    const std::vector<double> durations = list_durations_s(other);
    all.insert(all.end(), durations.begin(), durations.end());
  }
  const double session_s = find_resolution(all, {1.0});
  const double own_s = find_resolution(list_durations_s(run), {1.0});
  return own_s > kCoarser * session_s ? own_s : session_s;
}

bool have_one_label(const SpeedBin& a, const SpeedBin& b) {
  return std::abs(a.high_m_s - b.high_m_s) < kSameLabel_m_s && std::abs(a.low_m_s - b.low_m_s) < kSameLabel_m_s;
}

/// The stretch of bins in common that chance makes least likely, with that chance.
std::pair<SharedPart, double> compare_bins(const CoastdownData& data, double scatter, std::size_t first,
                                           std::size_t second) {
  constexpr double kDifference = 2.5066 * 1.4142;  // density at the middle of the difference of two, inverse
  constexpr double kSameDistance = 0.05;           // chance that runs whose bins agree also have one distance. Assumed
  const CoastdownRun& a = data.runs[first];
  const CoastdownRun& b = data.runs[second];
  const double step_a = find_step_s(data, a);
  const double step_b = find_step_s(data, b);
  const bool same = std::abs(step_a - step_b) < 1e-6 * step_a;
  const double coarse_s = std::max(step_a, step_b);
  const double tolerance_s = same ? 0.02 * step_a : 0.505 * coarse_s;
  const double width_s = coarse_s;
  std::pair<SharedPart, double> best{{first, second, a.bins.size(), 0, 0}, 1.0};
  for (std::size_t i = 0; i < a.bins.size(); ++i) {
    for (std::size_t j = 0; j < b.bins.size(); ++j) {
      double chance = 1.0;
      for (std::size_t k = 0; i + k < a.bins.size() && j + k < b.bins.size(); ++k) {
        const SpeedBin& of_a = a.bins[i + k];
        const SpeedBin& of_b = b.bins[j + k];
        if (!have_one_label(of_a, of_b) || std::abs(of_a.duration_s - of_b.duration_s) > tolerance_s) break;
        chance *= std::min(1.0, width_s / (kDifference * scatter * of_b.duration_s));
        if (chance < best.second) best = {{first, second, a.bins.size(), j, j + k + 1}, chance};
      }
    }
  }
  const std::size_t shared = best.first.end - best.first.begin;
  const bool same_way = a.distance_m.has_value() && b.distance_m.has_value() && *a.distance_m == *b.distance_m;
  if (same_way && shared == a.bins.size() && shared == b.bins.size()) best.second *= kSameDistance;
  return best;
}

void find_shared_bins(const CoastdownData& data, std::vector<SharedPart>& parts) {
  constexpr double kMostChance = 0.01;
  const double scatter = find_bin_scatter(data);
  const std::size_t runs = data.runs.size();
  const double pairs = 0.5 * static_cast<double>(runs) * static_cast<double>(runs - 1);
  for (std::size_t second = 1; second < runs; ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      const auto [part, chance] = compare_bins(data, scatter, first, second);
      if (part.end == part.begin) continue;
      if (pairs * static_cast<double>(data.runs[second].bins.size()) * chance < kMostChance) parts.push_back(part);
    }
  }
}

void find_shared_traces(const CoastdownData& data, std::vector<SharedPart>& parts) {
  std::vector<RecordedSeries> coasts;
  std::vector<std::size_t> starts;
  for (const CoastdownRun& run : data.runs) {
    const auto top = std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
    const auto start = static_cast<std::ptrdiff_t>(top - run.speed_m_s.begin());
    coasts.push_back({{run.time_s.begin() + start, run.time_s.end()}, {top, run.speed_m_s.end()}});
    starts.push_back(static_cast<std::size_t>(start));
  }
  for (const SeriesRepeat& repeat : find_series_repeats(coasts)) {
    const std::size_t start = starts[repeat.second];
    parts.push_back(
        {repeat.first, repeat.second, coasts[repeat.first].time_s.size(), start + repeat.begin, start + repeat.end});
  }
}

/// Speeds of the shared part.
std::string describe_part(const CoastdownRun& run, const SharedPart& part) {
  const bool bins = !run.bins.empty();
  const double high = bins ? run.bins[part.begin].high_m_s : run.speed_m_s[part.begin];
  const double low = bins ? run.bins[part.end - 1].low_m_s : run.speed_m_s[part.end - 1];
  return fmt::format("{:.0f} to {:.0f} km/h", 3.6 * high, 3.6 * low);
}

/// Takes the shared part out; returns the run that is gone altogether, if one is.
std::optional<std::size_t> take_out(const SharedPart& part, CoastdownData& data, RunDoubt& doubt) {
  constexpr double kWhole = 0.9;
  CoastdownRun& run = data.runs[part.second];
  const std::size_t size = size_of(run);
  const auto shared = static_cast<double>(part.end - part.begin);
  const std::string names = call_run(data, part.first) + " and " + call_run(data, part.second);
  doubt = {DoubtKind::kRepeat, {data.runs[part.first].id, run.id}, "the same recording", 0.0, ""};
  if (shared >= kWhole * static_cast<double>(size)) {
    doubt.text = names + " are the same recording: it is counted once";
    return part.second;
  }
  const std::string speeds = describe_part(run, part);
  if (shared >= kWhole * static_cast<double>(part.first_size)) {
    doubt.text = fmt::format("{} are the same recording from {}: it is counted once, as a part of the longer one",
                             names, speeds);
    return part.first;
  }
  doubt.likely = "the same recording in part";
  doubt.text = fmt::format("{} are the same recording from {}: this part is counted once", names, speeds);
  const bool before = part.begin > size - part.end;
  keep_part(before ? 0 : part.end, before ? part.begin : size, run);
  return std::nullopt;
}

}  // namespace

std::string call_run(const CoastdownData& data, std::size_t run) {
  const bool several = std::any_of(data.runs.begin(), data.runs.end(), [&data](const CoastdownRun& other) {
    return other.session != data.runs.front().session;
  });
  const CoastdownRun& called = data.runs[run];
  return several ? fmt::format("run '{}' of '{}'", called.id, called.session) : fmt::format("run '{}'", called.id);
}

std::vector<RunDoubt> leave_out_repeats(CoastdownData& data) {
  std::vector<SharedPart> parts;
  if (data.runs.size() < 2) return {};
  if (data.runs.front().bins.empty()) {
    find_shared_traces(data, parts);
  } else {
    find_shared_bins(data, parts);
  }
  std::vector<RunDoubt> doubts;
  std::vector<bool> gone(data.runs.size(), false), cut(data.runs.size(), false);
  for (const SharedPart& part : parts) {
    if (gone[part.first] || gone[part.second] || cut[part.second]) continue;
    RunDoubt doubt;
    const std::optional<std::size_t> out = take_out(part, data, doubt);
    doubts.push_back(doubt);
    if (out.has_value()) {
      gone[*out] = true;
    } else {
      cut[part.second] = true;
    }
  }
  CoastdownData kept;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    if (!gone[i] && size_of(data.runs[i]) > 0) kept.runs.push_back(std::move(data.runs[i]));
  }
  data = std::move(kept);
  return doubts;
}

}  // namespace rollrig::estimation
