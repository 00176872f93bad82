#include "tests/support/planted_mistakes.h"

#include <algorithm>
#include <cmath>

#include "estimation/drum_deceleration/coast_curves.h"
#include "tests/support/coast_study.h"
#include "tests/support/coastdown_study.h"

namespace rollrig::tests {
namespace {

using namespace estimation;

constexpr double kPerKmh = 1.0 / 3.6;

double round_to(double value, double step) { return std::round(value / step) * step; }

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Written again: as it is, coarser, or in other units; on another clock.
void rewrite(std::vector<double>& time_s, std::vector<double>& speed_m_s, RandomStream& random) {
  const double shift_s = round_to(draw_between(random, -500.0, 500.0), 0.01);
  const std::size_t way = draw_index(random, 4);
  for (double& time : time_s) time += shift_s;
  for (double& speed : speed_m_s) {
    if (way == 1) speed = round_to(speed, 0.01);
    if (way == 2) speed = round_to(speed, 0.01 * kPerKmh);
    if (way == 3) speed = round_to(speed, 0.01 * 0.44704);
  }
}

std::size_t find_top(const std::vector<double>& speed_m_s) {
  return static_cast<std::size_t>(std::max_element(speed_m_s.begin(), speed_m_s.end()) - speed_m_s.begin());
}

/// First row after the top from which on the speed stays below; a pulse that was missed halves it in one row only.
std::size_t find_passing(const std::vector<double>& speed_m_s, double below_m_s) {
  for (std::size_t i = find_top(speed_m_s); i + 6 < speed_m_s.size(); ++i) {
    const auto first = speed_m_s.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::all_of(first, first + 6, [below_m_s](double speed) { return speed < below_m_s; })) return i;
  }
  return speed_m_s.size() - 7;
}

std::pair<std::size_t, std::size_t> draw_pair(RandomStream& random, std::size_t count) {
  const std::size_t a = draw_index(random, count);
  const std::size_t b = (a + 1 + draw_index(random, count - 1)) % count;
  return {std::min(a, b), std::max(a, b)};
}

/// Stretch of a run: all of it, or at least 40 %.
std::pair<std::size_t, std::size_t> draw_stretch(RandomStream& random, std::size_t count) {
  if (random.uniform() < 0.3) return {0, count};
  const auto least = static_cast<std::size_t>(std::ceil(0.4 * static_cast<double>(count)));
  const std::size_t length = least + draw_index(random, count - least + 1);
  const std::size_t begin = draw_index(random, count - length + 1);
  return {begin, begin + length};
}

/// Rows from the top on, condensed in time where the speed is in a stretch.
void brake_rows(double high_m_s, double low_m_s, double factor, std::vector<double>& time_s,
                const std::vector<double>& speed_m_s) {
  const std::vector<double> before = time_s;
  for (std::size_t i = find_top(speed_m_s) + 1; i < time_s.size(); ++i) {
    const bool braked = speed_m_s[i] <= high_m_s && speed_m_s[i] >= low_m_s;
    time_s[i] = time_s[i - 1] + (before[i] - before[i - 1]) * (braked ? factor : 1.0);
  }
}

CoastSeries& main_series(CoastRun& run) { return run.drum.has_value() ? *run.drum : *run.wheel; }

std::vector<std::size_t> list_drum_runs(const CoastSet& set) {
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    if (set.runs[i].drum.has_value()) runs.push_back(i);
  }
  return runs;
}

}  // namespace

Judged judge(const Planted& planted, const std::vector<RunDoubt>& doubts) {
  Judged judged;
  std::size_t named = 0;
  for (const RunDoubt& doubt : doubts) {
    bool guilty = false;
    for (const std::string& run : doubt.runs) guilty = guilty || is_among(run, planted.runs);
    if (planted.kind == DoubtKind::kRepeat && doubt.kind == DoubtKind::kRepeat) {
      guilty = is_among(doubt.runs[0], planted.runs) && is_among(doubt.runs[1], planted.runs);
    }
    judged.accuses_innocent = judged.accuses_innocent || !guilty;
    const bool right = doubt.kind == planted.kind && doubt.likely.find(planted.likely) != std::string::npos;
    if (!guilty || !right) continue;
    for (const std::string& run : doubt.runs) named += is_among(run, planted.runs) ? 1 : 0;
  }
  judged.is_found = named >= planted.runs.size();
  return judged;
}

std::size_t draw_index(RandomStream& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

double draw_between(RandomStream& random, double low, double high) { return low + (high - low) * random.uniform(); }

Planted plant_repeat(CoastdownData& data, RandomStream& random) {
  const std::size_t from = draw_index(random, data.runs.size());
  CoastdownRun copy = data.runs[from];
  copy.id = "copy";
  if (random.uniform() < 0.5) copy.session = "copied";
  if (random.uniform() < 0.5) copy.heading = -copy.heading;
  if (copy.start_s.has_value()) *copy.start_s += 4000.0;
  rewrite(copy.time_s, copy.speed_m_s, random);
  const bool rounded = copy.bins.size() >= 5 && random.uniform() < 0.5;
  for (SpeedBin& bin : copy.bins) bin.duration_s = rounded ? round_to(bin.duration_s, 0.05) : bin.duration_s;
  data.runs.push_back(copy);
  return {DoubtKind::kRepeat, {data.runs[from].id, "copy"}, "the same recording"};
}

Planted plant_shared_part(CoastdownData& data, RandomStream& random) {
  const auto [first, second] = draw_pair(random, data.runs.size());
  const CoastdownRun& from = data.runs[first];
  CoastdownRun& to = data.runs[second];
  to.total_s.reset();
  to.distance_m.reset();
  if (!to.bins.empty()) {
    const std::size_t bins = std::min(from.bins.size(), to.bins.size());
    const std::size_t least = std::max<std::size_t>(3, (2 * bins + 4) / 5);  // 40 %
    const std::size_t count = std::min(least + draw_index(random, bins - least + 1), bins);
    for (std::size_t i = 0; i < count; ++i) to.bins[i] = from.bins[i];
    return {DoubtKind::kRepeat, {from.id, to.id}, "the same recording"};
  }
  // the fast part of the one, then the slow part of the other
  const double join_m_s = draw_between(random, 0.3, 0.7) * from.speed_m_s.front();
  CoastdownRun joined = to;
  joined.time_s.clear();
  joined.speed_m_s.clear();
  for (std::size_t i = 0; i < from.time_s.size() && from.speed_m_s[i] > join_m_s; ++i) {
    joined.time_s.push_back(from.time_s[i]);
    joined.speed_m_s.push_back(from.speed_m_s[i]);
  }
  std::size_t slow = 0;  // none where the other run ends above that speed
  while (slow < to.time_s.size() && to.speed_m_s[slow] > join_m_s) ++slow;
  const double slow_from_s = joined.time_s.back() + 0.1;
  for (std::size_t i = slow; i < to.time_s.size(); ++i) {
    joined.time_s.push_back(to.time_s[i] + (slow_from_s - to.time_s[slow]));
    joined.speed_m_s.push_back(to.speed_m_s[i]);
  }
  to = joined;
  return {DoubtKind::kRepeat, {from.id, to.id}, "the same recording"};
}

Planted plant_labels(CoastdownData& data, RandomStream& random) {
  Planted planted{DoubtKind::kLabels, {}, ""};
  const std::size_t way = draw_index(random, 4);
  const int bins = 1 + static_cast<int>(draw_index(random, 2));
  constexpr double kWidths[] = {0.8, 1.2, 2.0, 0.5};
  double width = kWidths[draw_index(random, 4)];
  for (const CoastdownRun& run : data.runs) {  // no label may come to lie below 5 km/h
    const double top = run.bins.front().high_m_s;
    if (top - (top - run.bins.back().low_m_s) * width < 5.0 * kPerKmh) width = 0.8;
  }
  const bool all = random.uniform() < 0.3;
  std::vector<std::size_t> guilty;
  for (std::size_t i = 0; i < data.runs.size() && all; ++i) guilty.push_back(i);
  if (!all) guilty.push_back(draw_index(random, data.runs.size()));
  for (const std::size_t i : guilty) {
    CoastdownRun& run = data.runs[i];
    planted.runs.push_back(run.id);
    const double step = run.bins.front().high_m_s - run.bins.front().low_m_s;
    const double top = run.bins.front().high_m_s;
    for (SpeedBin& bin : run.bins) {
      for (double* label : {&bin.high_m_s, &bin.low_m_s}) {
        if (way == 0) *label /= 1.609344;
        if (way == 1) *label -= bins * step;
        if (way == 2) *label += bins * step;
        if (way == 3) *label = top - (top - *label) * width;
      }
    }
  }
  const char* kWords[] = {"mph", "shifted down", "shifted up", "wide"};
  planted.likely = kWords[way];
  return planted;
}

Planted plant_brake(CoastdownData& data, RandomStream& random) {
  CoastdownRun& run = data.runs[draw_index(random, data.runs.size())];
  const double factor = 1.0 / (1.0 + draw_between(random, 0.25, 1.0));
  run.total_s.reset();  // of a run that is braked, they are those of the braked run
  run.distance_m.reset();
  if (!run.bins.empty()) {
    const auto [begin, end] = draw_stretch(random, run.bins.size());
    for (std::size_t i = begin; i < end; ++i) run.bins[i].duration_s *= factor;
    return {DoubtKind::kOdd, {run.id}, "braked"};
  }
  const double top = run.speed_m_s.front();
  const double low = run.speed_m_s.back();
  const auto [begin, end] = draw_stretch(random, 100);
  const auto speed_at = [&](std::size_t percent) { return top - (top - low) * static_cast<double>(percent) / 100.0; };
  brake_rows(speed_at(begin) + 0.1, speed_at(end), factor, run.time_s, run.speed_m_s);
  return {DoubtKind::kOdd, {run.id}, "braked"};
}

CoastdownData draw_runs(const CoastdownData& data, RandomStream& random) {
  const std::string session = data.runs[draw_index(random, data.runs.size())].session;
  CoastdownData drawn;
  const double share = draw_between(random, 0.5, 1.0);
  for (const CoastdownRun& run : data.runs) {
    if (run.session != session || random.uniform() > share) continue;
    drawn.runs.push_back(run);
  }
  return drawn;
}

CoastdownData make_random_coastdowns(RandomStream& random, bool bins) {
  CoastdownStudy study;
  study.pairs = 3 + static_cast<int>(draw_index(random, 6));
  study.mass_kg = draw_between(random, 1000.0, 2600.0);
  study.effective_mass_kg = 1.03 * study.mass_kg;
  study.from_km_h = 5.0 * std::round(draw_between(random, 18.0, 28.0)) + 1.0;
  study.to_km_h = draw_between(random, 15.0, 45.0);
  study.interval_s = random.uniform() < 0.5 ? 0.1 : 0.5;
  study.noise_sd_m_s = draw_between(random, 0.01, 0.06);
  study.wind_m_s = draw_between(random, -2.0, 2.0);
  study.slope = draw_between(random, -1e-3, 1e-3);
  study.run_force_sd_N = draw_between(random, 0.0, 5.0);
  study.run_wind_sd_m_s = draw_between(random, 0.0, 0.4);
  study.gust_N_sqrt_s = draw_between(random, 0.0, 15.0);
  const auto seed = static_cast<std::uint64_t>(random.uniform() * 1e9);
  if (!bins) return simulate_coastdowns(study, seed);
  study.noise_sd_m_s = 0.0;
  study.resolution_km_h = 0.0;
  study.interval_s = 0.05;
  const CoastdownData traces = simulate_coastdowns(study, seed);
  CoastdownData data = cut_into_bins(traces, 5.0);
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    CoastdownRun& run = data.runs[i];
    run.start_s = 900.0 * static_cast<double>(i);
    const CoastdownRun& trace = traces.runs[i];
    double total_s = 0.0, way_m = 0.0;
    for (std::size_t row = 1; row < trace.time_s.size(); ++row) {
      if (trace.speed_m_s[row - 1] > run.bins.front().high_m_s || trace.speed_m_s[row] < run.bins.back().low_m_s) {
        continue;
      }
      way_m += 0.5 * (trace.speed_m_s[row] + trace.speed_m_s[row - 1]) * (trace.time_s[row] - trace.time_s[row - 1]);
    }
    for (SpeedBin& bin : run.bins) {
      bin.duration_s = round_to(bin.duration_s + 0.02 * random.normal(), 0.01);
      total_s += bin.duration_s;
    }
    run.total_s = round_to(total_s, 0.01);
    run.distance_m = round_to(way_m * (1.0 + 1e-3 * random.normal()), 0.01);
  }
  return data;
}

Planted plant_repeat(CoastSet& set, RandomStream& random) {
  const std::vector<std::size_t> runs = list_drum_runs(set);
  const std::size_t from = runs[draw_index(random, runs.size())];
  CoastRun copy = set.runs[from];
  copy.id = "copy.csv";
  rewrite(copy.drum->time_s, copy.drum->speed_m_s, random);
  set.runs.push_back(copy);
  return {DoubtKind::kRepeat, {set.runs[from].id, "copy.csv"}, "the same recording"};
}

Planted plant_shared_part(CoastSet& set, RandomStream& random) {
  const std::vector<std::size_t> runs = list_drum_runs(set);
  const auto [first, second] = draw_pair(random, runs.size());
  const CoastRun& from = set.runs[runs[first]];
  CoastRun& to = set.runs[runs[second]];
  const CoastSeries& source = *from.drum;
  CoastSeries& target = *to.drum;
  const double join_m_s =
      draw_between(random, 0.35, 0.7) * std::min(*std::max_element(source.speed_m_s.begin(), source.speed_m_s.end()),
                                                 *std::max_element(target.speed_m_s.begin(), target.speed_m_s.end()));
  CoastSeries joined;
  const std::size_t last = find_passing(source.speed_m_s, join_m_s);
  joined.time_s.assign(source.time_s.begin(), source.time_s.begin() + static_cast<std::ptrdiff_t>(last));
  joined.speed_m_s.assign(source.speed_m_s.begin(), source.speed_m_s.begin() + static_cast<std::ptrdiff_t>(last));
  std::size_t next = find_passing(target.speed_m_s, join_m_s);
  const double shift_s = joined.time_s.back() + target.time_s[next] - target.time_s[next - 1] - target.time_s[next];
  for (; next < target.time_s.size(); ++next) {
    joined.time_s.push_back(target.time_s[next] + shift_s);
    joined.speed_m_s.push_back(target.speed_m_s[next]);
  }
  target = joined;
  return {DoubtKind::kRepeat, {from.id, to.id}, "the same recording"};
}

Planted plant_state(CoastSet& set, RandomStream& random) {
  const std::vector<std::size_t> runs = list_drum_runs(set);
  CoastRun& run = set.runs[runs[draw_index(random, runs.size())]];
  const bool was_loaded = run.state == CoastState::kLoaded;
  run.state = was_loaded ? CoastState::kLifted : CoastState::kLoaded;
  if (!was_loaded) {
    run.pressure_Pa = set.reference_pressure_Pa.value_or(300e3);
    for (const CoastRun& other : set.runs) run.load_N = std::max(run.load_N, other.load_N);
  }
  return {DoubtKind::kState, {run.id}, was_loaded ? "it is loaded" : "it is lifted"};
}

Planted plant_load(CoastSet& set, RandomStream& random) {
  const double load_N = draw_between(random, 100.0, 1500.0);
  const double factor = draw_between(random, 1.1, 7.0);
  std::vector<std::size_t> loaded;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    if (set.runs[i].state != CoastState::kLoaded) continue;
    set.runs[i].load_N = load_N;
    loaded.push_back(i);
  }
  const std::size_t guilty = loaded[draw_index(random, loaded.size())];
  set.runs[guilty].load_N *= random.uniform() < 0.5 ? factor : 1.0 / factor;
  return {DoubtKind::kLoad, {set.runs[guilty].id}, "different loads"};
}

Planted plant_brake(CoastSet& set, RandomStream& random) {
  const std::vector<std::size_t> runs = list_drum_runs(set);
  const std::size_t place = runs[draw_index(random, runs.size())];
  CoastSet alone = set;
  alone.runs = {set.runs[place]};
  const CoastCurve own = make_coast_curves(find_coasts(alone)).front();
  CoastSet lifted = set;
  lifted.runs.clear();
  for (const CoastRun& run : set.runs) {
    if (run.state == CoastState::kLifted && run.drum.has_value()) lifted.runs.push_back(run);
  }
  const std::vector<CoastCurve> lifted_curves = make_coast_curves(find_coasts(lifted));
  std::vector<const CoastCurve*> all;
  for (const CoastCurve& curve : lifted_curves) all.push_back(&curve);
  const CoastCurve drum_alone = calc_median_curve(all);
  CoastRun& run = set.runs[place];
  CoastSeries& series = main_series(run);
  const std::vector<double> before = series.time_s;
  const double top = *std::max_element(series.speed_m_s.begin(), series.speed_m_s.end());
  const auto [begin, end] = draw_stretch(random, 100);
  const double high = begin == 0 ? top + 1.0 : top * (1.0 - static_cast<double>(begin) / 100.0);
  const double low = top * (1.0 - static_cast<double>(end) / 100.0);
  const auto middle = static_cast<std::size_t>(0.5 * top / kCurveBin_m_s);
  const double base = own.at(middle) - (run.state == CoastState::kLoaded ? drum_alone.at(middle) : 0.0);
  const double brake_m_s2 = draw_between(random, 0.25, 1.0) * base;
  for (std::size_t i = find_top(series.speed_m_s) + 1; i < series.time_s.size(); ++i) {
    const double speed = series.speed_m_s[i];
    double own_m_s2 = own.at(static_cast<std::size_t>(speed / kCurveBin_m_s));
    if (std::isnan(own_m_s2)) own_m_s2 = own.at(middle);
    const double factor = speed <= high && speed >= low ? own_m_s2 / (own_m_s2 + brake_m_s2) : 1.0;
    series.time_s[i] = series.time_s[i - 1] + (before[i] - before[i - 1]) * factor;
  }
  return {DoubtKind::kOdd, {run.id}, ""};
}

CoastSet make_random_coasts(RandomStream& random) {
  CoastStudy study;
  study.noise_m_s = draw_between(random, 0.005, 0.015);
  study.missed_share = draw_between(random, 0.0, 0.03);
  study.resonance = draw_between(random, 0.0, 0.05);
  study.loaded_scatter = draw_between(random, 0.002, 0.015);
  study.lifted_scatter = draw_between(random, 0.002, 0.02);
  study.exponent = draw_between(random, -0.6, -0.2);
  study.left_over_right = draw_between(random, -0.03, 0.03);
  if (random.uniform() < 0.5) study.pressures_Pa = {280e3, 350e3, 420e3};
  study.lifted_runs = 4 + static_cast<int>(draw_index(random, 4));
  CoastSet set = make_coasts(study, static_cast<std::uint64_t>(random.uniform() * 1e9));
  for (std::size_t i = 0; i < set.runs.size(); ++i) set.runs[i].id = std::to_string(i + 1) + ".csv";
  return set;
}

}  // namespace rollrig::tests
