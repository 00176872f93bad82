#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "estimation/road_load/coastdown_points.h"
#include "estimation/road_load/road_load_procedure.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

// The lowest of them and their step: UN GTR 15 Annex 4, 2.2
constexpr int kLowestReference_km_h = 20;
constexpr int kReferenceStep_km_h = 10;
constexpr int kHighestReference_km_h = 250;
constexpr int kHalfStep_km_h = 5;
constexpr double kMeterPerSecond = 1.0 / 3.6;  // of a km/h

/// Times by the edge, 15, 25, 35 ... km/h; edges that a run passes with too few samples for a time.
struct EdgeTimes {
  std::map<int, double> times_s;
  std::vector<int> lost_km_h;
};

EdgeTimes find_edge_times(const CoastdownRun& run, const RoadLoadProcedureOptions& options) {
  constexpr double kMargin_m_s = 1e-6;
  std::vector<double> edges_m_s;
  for (int km_h = kLowestReference_km_h - kHalfStep_km_h; km_h <= kHighestReference_km_h + kHalfStep_km_h;
       km_h += kReferenceStep_km_h) {
    const double edge_m_s = km_h * kMeterPerSecond;
    if (edge_m_s < options.speed_from_m_s - kMargin_m_s || edge_m_s > options.speed_to_m_s + kMargin_m_s) continue;
    edges_m_s.push_back(edge_m_s);
  }
  EdgeTimes found;
  for (const SpeedPassing& passing : find_passing_times(run, edges_m_s)) {
    const auto km_h = static_cast<int>(std::lround(kKmhPerMs * passing.speed_m_s));
    if (passing.time_s.has_value()) {
      found.times_s[km_h] = *passing.time_s;
    } else {
      found.lost_km_h.push_back(km_h);
    }
  }
  return found;
}

/// The same of times through bins: from the first edge on, as far as bins follow each other.
std::map<int, double> add_up_bins(const CoastdownRun& run) {
  constexpr double kSame_km_h = 0.01;
  std::map<int, double> times;
  double now_s = 0.0;
  double last_km_h = std::numeric_limits<double>::infinity();
  for (const SpeedBin& bin : run.bins) {
    const double high_km_h = 3.6 * bin.high_m_s;
    const double low_km_h = 3.6 * bin.low_m_s;
    const auto put = [&times, &now_s](double edge_km_h) {
      const int km_h = static_cast<int>(std::lround(edge_km_h));
      const bool is_edge = km_h % kReferenceStep_km_h == kHalfStep_km_h;
      if (is_edge && std::abs(edge_km_h - km_h) < kSame_km_h) times[km_h] = now_s;
    };
    if (std::abs(high_km_h - last_km_h) > kSame_km_h) {
      // a gap: the times below it have another origin, far enough that no difference across it counts
      now_s += 1e6;
      put(high_km_h);
    }
    now_s += bin.duration_s;
    put(low_km_h);
    last_km_h = low_km_h;
  }
  return times;
}

/// Times through v + 5 to v - 5 km/h at the reference speeds of a run.
std::map<int, double> find_reference_times(const std::map<int, double>& passing,
                                           const RoadLoadProcedureOptions& options) {
  constexpr double kAcrossGap_s = 1e5;
  std::map<int, double> times;
  for (int km_h = kLowestReference_km_h; km_h <= kHighestReference_km_h; km_h += kReferenceStep_km_h) {
    const auto upper = passing.find(km_h + kHalfStep_km_h);
    const auto lower = passing.find(km_h - kHalfStep_km_h);
    const double limit_m_s = 1e-6;
    if (upper == passing.end() || lower == passing.end()) continue;
    if ((km_h - kHalfStep_km_h) * kMeterPerSecond < options.speed_from_m_s - limit_m_s) continue;
    if ((km_h + kHalfStep_km_h) * kMeterPerSecond > options.speed_to_m_s + limit_m_s) continue;
    const double duration_s = lower->second - upper->second;
    if (duration_s > 0.0 && duration_s < kAcrossGap_s) times[km_h] = duration_s;
  }
  return times;
}

/// Says that a run passes speeds with too few samples. Throws InputError where it has no reference speed for that.
void report_lost_speeds(const CoastdownRun& run, const ReferenceRun& of_run, const std::vector<int>& lost_km_h,
                        std::vector<std::string>& warnings) {
  if (lost_km_h.empty()) return;
  const double interval_s = (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.time_s.size() - 1);
  const std::string what =
      fmt::format("run {} has too few samples near {} km/h for a time (on average one every {:.3g} s)", of_run.name,
                  fmt::join(lost_km_h, ", "), interval_s);
  if (of_run.values.empty()) {
    throw InputError(
        {what, "", 0, "time_s", "", "four samples at least within 10 km/h of each limit of a speed bin", ""});
  }
  warnings.push_back(what + ": the reference speeds beside it are not in this run");
}

std::vector<ReferenceRun> list_reference_runs(const CoastdownData& data, const RoadLoadProcedureOptions& options,
                                              std::vector<std::string>& warnings) {
  std::vector<ReferenceRun> runs;
  const std::vector<double> positions = find_positions(data);
  for (const CoastdownRun& run : data.runs) {
    const EdgeTimes edges = run.bins.empty() ? find_edge_times(run, options) : EdgeTimes{add_up_bins(run), {}};
    runs.push_back({name_of_run(run, data), run.session, run.heading, find_reference_times(edges.times_s, options),
                    positions[runs.size()]});
    report_lost_speeds(run, runs.back(), edges.lost_km_h, warnings);
  }
  std::vector<std::string> without;
  for (const ReferenceRun& run : runs) {
    if (run.values.empty()) without.push_back(run.name);
  }
  const bool none = without.size() == runs.size();
  if (!none && !without.empty()) {
    warnings.push_back(fmt::format("not used, without a time from v + 5 to v - 5 km/h of a reference speed v: {} {}",
                                   without.size() == 1 ? "run" : "runs", fmt::join(without, ", ")));
  }
  if (none && !data.runs.empty() && !data.runs.front().bins.empty()) {
    throw InputError({"no bins end at v + 5 and v - 5 km/h of a reference speed v", "", 0, "v_hi_kmh", "",
                      "edges at 15, 25, 35 ... km/h: the reference speeds are 20, 30, 40 ... km/h", ""});
  }
  return runs;
}

/// Throws InputError where too few reference speeds lie below the highest speed, which is that of a test in m/s.
void require_speeds_in_km_h(const CoastdownFile& file, const std::vector<ReferenceRun>& runs) {
  constexpr double kMostTop_km_h = 60.0;  // Assumed: 200 km/h in m/s is 56
  constexpr std::size_t kFewest = 3;
  std::set<int> speeds;
  for (const ReferenceRun& run : runs) {
    for (const auto& [km_h, value] : run.values) speeds.insert(km_h);
  }
  double top_m_s = 0.0;
  for (const CoastdownRun& run : file.data.runs) {
    for (const double speed_m_s : run.speed_m_s) top_m_s = std::max(top_m_s, speed_m_s);
    for (const SpeedBin& bin : run.bins) top_m_s = std::max(top_m_s, bin.high_m_s);
  }
  if (speeds.size() >= kFewest || kKmhPerMs * top_m_s > kMostTop_km_h) return;
  throw InputError({fmt::format("the speeds end at {:.1f}: the runs have a time at {} only. Are the speeds in m/s?",
                                kKmhPerMs * top_m_s, format_count(speeds.size(), "reference speed")),
                    "", 0, file.is_trace ? "speed_km_h" : "v_hi_kmh", fmt::format("{:.1f}", kKmhPerMs * top_m_s),
                    "speeds in km/h, from 135 km/h to 15 km/h", ""});
}

void check_overlaps(RoadLoadProcedure& procedure) {
  constexpr double kMost_N = 10.0;
  constexpr double kMostShare = 0.05;
  const ReferenceResult& reference = procedure.reference;
  const auto parts = std::max_element(reference.pairs.begin(), reference.pairs.end(),
                                      [](const auto& a, const auto& b) { return a.part < b.part; });
  if (parts == reference.pairs.end() || parts->part == 0) return;
  constexpr const char* kClause = "UN GTR 15 Annex 4, 4.3.1.3.4";
  if (reference.overlaps.empty()) {
    procedure.checks.push_back(
        {"split runs", CheckStatus::kFail, "no reference speed in both parts", "one at least", kClause});
    procedure.warnings.push_back(
        "the parts of the split runs have no reference speed in common: nothing shows that they go together");
    return;
  }
  double worst = 0.0;
  std::string found;
  for (std::size_t i = 0; i < reference.overlaps.size(); ++i) {
    const auto at = std::find(reference.speeds.begin(), reference.speeds.end(), reference.overlaps[i]);
    const double force_N = reference.resistances[static_cast<std::size_t>(at - reference.speeds.begin())];
    const double share = std::abs(reference.overlap_differences[i]) / std::max(kMost_N, kMostShare * force_N);
    if (!found.empty() && share <= worst) continue;
    worst = share;
    found = fmt::format("{:+.1f} N at {} km/h", reference.overlap_differences[i], reference.overlaps[i]);
  }
  procedure.checks.push_back({"split runs, force in common", worst <= 1.0 ? CheckStatus::kPass : CheckStatus::kFail,
                              found, "10 N or 5 %", kClause});
}

/// The times of the runs at the reference speeds that are used, as forces.
void put_coastdown_points(const std::vector<ReferenceRun>& runs, const PairRule& rule, RoadLoadProcedure& procedure) {
  const std::vector<int>& used = procedure.reference.speeds;
  for (const ReferenceRun& run : runs) {
    procedure.run_names.push_back(run.name);
    for (const auto& [km_h, value] : run.values) {
      if (std::find(used.begin(), used.end(), km_h) == used.end()) continue;
      procedure.points.push_back({run.name, run.heading, km_h * kMeterPerSecond, rule.resistance(value), 0.0});
    }
  }
}

}  // namespace

RoadLoadProcedure evaluate_wltp_coastdowns(const CoastdownFile& file, const RoadLoadProcedureOptions& options) {
  RoadLoadProcedure procedure;
  procedure.kind = RoadLoadProcedureKind::kWltp;
  put_masses(options, procedure);
  std::vector<RoadLoadCheck> wind_checks;
  const std::vector<std::string> windy = check_winds(file.data, kWltpWind, wind_checks);
  const std::vector<ReferenceRun> runs = list_reference_runs(file.data, options, procedure.warnings);
  require_speeds_in_km_h(file, runs);
  std::map<int, double> speeds_m_s;
  for (int km_h = kLowestReference_km_h; km_h <= kHighestReference_km_h; km_h += kReferenceStep_km_h) {
    speeds_m_s[km_h] = km_h * kMeterPerSecond;
  }
  const double effective_mass_kg = procedure.correction.mass_kg + procedure.rotating_mass_kg;
  const PairRule rule{true, effective_mass_kg * 2.0 * kHalfStep_km_h * kMeterPerSecond, "coastdown times"};
  put_reference_result(evaluate_reference_runs(runs, speeds_m_s, rule, windy), speeds_m_s, procedure);
  put_used_conditions(file.data, options, std::move(wind_checks), procedure);
  if (file.data.runs.front().conditions.wind_m_s.empty()) {
    procedure.warnings.push_back(
        "no column wind_m_s: nothing is subtracted for the wind, which both headings have in f0 (f2 times its square)");
  }
  check_reference_speeds(procedure);
  check_reference_precision(procedure);
  check_overlaps(procedure);
  finish_procedure(options, procedure);
  put_coastdown_points(runs, rule, procedure);
  put_fitted(procedure);
  doubt_sessions(file.data, windy, procedure);  // also of rejected pairs
  add_warnings(doubt_session_units(file.data), procedure);
  doubt_units(procedure);
  doubt_recorded_conditions(file.data, "wind_m_s", SlopeForce::kIncluded, procedure);
  return procedure;
}

}  // namespace rollrig::estimation
