#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <Eigen/QR>

#include "estimation/road_load/coastdown_points.h"
#include "estimation/road_load/coastdown_units.h"
#include "estimation/road_load/recorded_wind.h"
#include "estimation/road_load/road_load_procedure.h"
#include "estimation/road_load/trace_fit.h"
#include "estimation/run_checks/robust_statistics.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGasConstant_J_kgK = 287.058;  // of air: 40 CFR 1037.528(h)(10)
constexpr double kStretch_s = 5.0;              // Assumed: of the means whose differences are fitted
constexpr std::size_t kFewestStretches = 3;     // of a run
constexpr double kLeastYaw_rad = 0.0175;        // Assumed: 1 deg, below which yaw says nothing
constexpr double kSpeedScale_m_s = 20.0;        // makes the components of variance alike in size

/// What the equation of motion needs at one sample.
struct TraceSample {
  double time_s = 0.0;
  double speed_m_s = 0.0;
  AirFlow air;
  double rolling = 1.0;  // factor of A and B
  double density_kg_m3 = 0.0;
  double slope = 0.0;  // uphill for the vehicle
};

struct TraceRun {
  std::size_t index = 0;  // in the data
  int heading = 0;
  std::vector<TraceSample> samples;
  std::size_t stretch = 0;  // samples of one mean
};

/// Which coefficients there are, and where.
struct TraceTerms {
  bool has_B = true;
  int yaw_degree = 0;
  bool has_slope = false;
  Index first_drag() const { return has_B ? 2 : 1; }
  Index count() const { return first_drag() + yaw_degree + 1 + (has_slope ? 1 : 0); }
};

double at_or(const std::vector<double>& values, std::size_t at, double otherwise) {
  return values.empty() ? otherwise : values[at];
}

/// The coasting part of a run between the speeds of the options.
TraceRun cut_trace(const CoastdownRun& run, std::size_t index, const RoadLoadProcedureOptions& options,
                   double reference_pressure_Pa) {
  constexpr double kCell_m_s = 5.0 / 3.6;
  TraceRun trace;
  trace.index = index;
  trace.heading = run.heading;
  const std::vector<SpeedCell> cells = cut_into_cells(run, {kCell_m_s, options.speed_from_m_s, options.speed_to_m_s});
  if (cells.size() < 2) return trace;
  const CoastdownConditions& at = run.conditions;
  const bool mean_wind = options.kind == RoadLoadProcedureKind::kJ1263;
  const double wind_m_s = at.wind_m_s.empty() ? 0.0 : calc_mean(at.wind_m_s);
  const double across_m_s = at.crosswind_m_s.empty() ? 0.0 : calc_mean(at.crosswind_m_s);
  for (std::size_t i = cells.front().first_sample; i < cells.back().end_sample; ++i) {
    TraceSample sample;
    sample.time_s = run.time_s[i];
    sample.speed_m_s = run.speed_m_s[i];
    if (!mean_wind && !at.air_speed_m_s.empty()) {
      sample.air = {at.air_speed_m_s[i], at_or(at.yaw_rad, i, 0.0)};
    } else {
      sample.air = calc_air_flow(sample.speed_m_s, run.heading * (mean_wind ? wind_m_s : at_or(at.wind_m_s, i, 0.0)),
                                 run.heading * (mean_wind ? across_m_s : at_or(at.crosswind_m_s, i, 0.0)));
    }
    const double ambient_K = at_or(at.ambient_K, i, options.reference_temperature_K);
    sample.rolling = 1.0 / (1.0 + options.rolling_fall_per_K * (ambient_K - options.reference_temperature_K));
    sample.density_kg_m3 = at_or(at.ambient_pressure_Pa, i, reference_pressure_Pa) / (kGasConstant_J_kgK * ambient_K);
    sample.slope = run.heading * at_or(at.slope, i, 0.0);
    trace.samples.push_back(sample);
  }
  if (trace.samples.size() < 2) return trace;
  const double length_s = trace.samples.back().time_s - trace.samples.front().time_s;
  const double interval_s = length_s / static_cast<double>(trace.samples.size() - 1);
  trace.stretch = static_cast<std::size_t>(std::max(2L, std::lround(kStretch_s / interval_s)));
  return trace;
}

/// Air speed and yaw at the vehicle against those that the wind beside the road gives: a line through both, as in
/// 40 CFR 1037.528(g). Where there is no such wind, says by how much the air speed is off on average of both headings,
/// and returns false.
bool calibrate_air(const CoastdownData& data, std::vector<TraceRun>& traces, std::vector<std::string>& warnings) {
  constexpr double kLeastYawSpread_rad = 0.5 * 0.017453292519943295;
  constexpr double kMostScale = 0.02;
  const bool has_wind = std::all_of(data.runs.begin(), data.runs.end(), [](const CoastdownRun& run) {
    return !run.conditions.wind_m_s.empty() && !run.conditions.crosswind_m_s.empty();
  });
  if (!has_wind) {
    double along[2] = {0.0, 0.0}, speed[2] = {0.0, 0.0};
    for (const TraceRun& trace : traces) {
      for (const TraceSample& sample : trace.samples) {
        along[trace.heading > 0 ? 0 : 1] += sample.air.speed_m_s * std::cos(sample.air.yaw_rad);
        speed[trace.heading > 0 ? 0 : 1] += sample.speed_m_s;
      }
    }
    const double scale = 0.5 * (along[0] / speed[0] + along[1] / speed[1]);
    if (std::abs(scale - 1.0) > kMostScale) {
      warnings.push_back(
          fmt::format("the air speed is {:+.1f} % off the speed on average of both headings: the anemometer or its "
                      "place (blockage) "
                      "is not calibrated, or a column is in another unit. The drag area is wrong by about twice that",
                      100.0 * (scale - 1.0)));
    }
    return false;
  }
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, p = 0.0, q = 0.0, pp = 0.0, pq = 0.0;
  const auto theory = [&data](const TraceRun& trace, double speed_m_s) {
    const CoastdownConditions& at = data.runs[trace.index].conditions;
    return calc_air_flow(speed_m_s, trace.heading * calc_mean(at.wind_m_s),
                         trace.heading * calc_mean(at.crosswind_m_s));
  };
  for (const TraceRun& trace : traces) {
    for (const TraceSample& sample : trace.samples) {
      const AirFlow expected = theory(trace, sample.speed_m_s);
      n += 1.0;
      x += expected.speed_m_s;
      y += sample.air.speed_m_s;
      xx += expected.speed_m_s * expected.speed_m_s;
      xy += expected.speed_m_s * sample.air.speed_m_s;
      p += expected.yaw_rad;
      q += sample.air.yaw_rad;
      pp += expected.yaw_rad * expected.yaw_rad;
      pq += expected.yaw_rad * sample.air.yaw_rad;
    }
  }
  const double a1 = (xy - x * y / n) / (xx - x * x / n);
  const double a0 = (y - a1 * x) / n;
  const double yaw_spread = std::sqrt(std::max(0.0, pp / n - p * p / (n * n)));
  const double b1 = yaw_spread > kLeastYawSpread_rad ? (pq - p * q / n) / (pp - p * p / n) : 1.0;
  const double b0 = (q - b1 * p) / n;
  for (TraceRun& trace : traces) {
    for (TraceSample& sample : trace.samples) {
      sample.air.speed_m_s = (sample.air.speed_m_s - a0) / a1;
      sample.air.yaw_rad = (sample.air.yaw_rad - b0) / b1;
    }
  }
  return true;
}

/// Throws InputError where the air speed of all runs is to the vehicle speed as a unit is to another one, which no wind
/// does on the median of both headings.
void require_one_speed_unit(const std::vector<TraceRun>& traces) {
  constexpr double kNear = 0.1;  // Assumed: what wind and the place of the anemometer add
  std::vector<double> air_m_s, speed_m_s;
  for (const TraceRun& trace : traces) {
    for (const TraceSample& sample : trace.samples) {
      air_m_s.push_back(sample.air.speed_m_s);
      speed_m_s.push_back(sample.speed_m_s);
    }
  }
  if (speed_m_s.empty()) return;
  const double air = calc_median(air_m_s), speed = calc_median(speed_m_s);
  const std::string guess = guess_speed_unit(air / speed, "air_speed_km_h", "speed_km_h", kNear);
  if (guess.empty()) return;
  throw InputError({"air_speed_km_h and speed_km_h are not in one unit" + guess, "", 0, "air_speed_km_h",
                    fmt::format("a median of {:.1f}; that of speed_km_h is {:.1f}", kKmhPerMs * air, kKmhPerMs * speed),
                    "both in km/h", ""});
}

/// What a coefficient is multiplied by at a sample.
VectorXd list_terms(const TraceTerms& terms, const TraceSample& sample, int heading) {
  VectorXd factors(terms.count());
  factors(0) = sample.rolling;
  if (terms.has_B) factors(1) = sample.rolling * sample.speed_m_s;
  double drag = 0.5 * sample.density_kg_m3 * sample.air.speed_m_s * sample.air.speed_m_s;
  for (int power = 0; power <= terms.yaw_degree; ++power) {
    factors(terms.first_drag() + power) = drag;
    drag *= sample.air.yaw_rad;
  }
  if (terms.has_slope) factors(terms.count() - 1) = heading;
  return factors;
}

/// Without B, no run has a slope of its own over the speed: it would take up the part of the loss that all runs have in
/// proportion to the speed, which f0 and f2 have to stand for.
Index count_components(const TraceTerms& terms) { return terms.has_B ? kTraceComponents : kSlopeOfRun; }

/// Differences of the mean speeds of neighboring stretches, as forces. The mean of a stretch weighs what happens
/// between the middles of two stretches most, so that each term enters with a triangle over both.
LinearBlock make_trace_block(const TraceRun& trace, const TraceTerms& terms, double mass_kg, double effective_kg) {
  const std::size_t N = trace.stretch;
  const std::size_t stretches = trace.samples.size() / N;
  const auto rows = static_cast<Index>(stretches > 0 ? stretches - 1 : 0);
  LinearBlock block;
  block.y = VectorXd::Zero(rows);
  block.X = MatrixXd::Zero(rows, terms.count());
  block.patterns.assign(static_cast<std::size_t>(count_components(terms)), MatrixXd::Zero(rows, rows));
  VectorXd length_s(rows), speed(rows);
  const auto per_sample = static_cast<double>(N);
  for (Index row = 0; row < rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * N;
    double fall_m_s = 0.0, slope = 0.0;
    VectorXd terms_sum = VectorXd::Zero(terms.count());
    double whole_s = 0.0, speed_sum = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      fall_m_s += (trace.samples[first + i].speed_m_s - trace.samples[first + N + i].speed_m_s) / per_sample;
    }
    for (std::size_t i = 0; i + 1 < 2 * N; ++i) {
      const TraceSample& a = trace.samples[first + i];
      const TraceSample& b = trace.samples[first + i + 1];
      const double weight = static_cast<double>(std::min(i + 1, 2 * N - 1 - i)) / per_sample * (b.time_s - a.time_s);
      whole_s += weight;
      slope += 0.5 * weight * (a.slope + b.slope);
      speed_sum += 0.5 * weight * (a.speed_m_s + b.speed_m_s);
      terms_sum += 0.5 * weight * (list_terms(terms, a, trace.heading) + list_terms(terms, b, trace.heading));
    }
    block.y(row) = calc_coastdown_force_N(effective_kg, fall_m_s, whole_s, mass_kg, slope / whole_s);
    block.X.row(row) = (terms_sum / whole_s).transpose();
    length_s(row) = whole_s;
    speed(row) = speed_sum / whole_s;
  }
  for (Index i = 0; i < rows; ++i) {
    for (Index j = std::max<Index>(0, i - 1); j <= std::min(rows - 1, i + 1); ++j) {
      const double noise = effective_kg * effective_kg / (length_s(i) * length_s(j) * per_sample);
      block.patterns[kSpeedNoise](i, j) = (i == j ? 2.0 : -1.0) * noise;
      block.patterns[kWhiteForce](i, j) = (i == j ? 2.0 / 3.0 : 1.0 / 6.0) / std::sqrt(length_s(i) * length_s(j));
    }
  }
  block.patterns[kForceOfRun].setOnes();
  if (terms.has_B) {
    block.patterns[kSlopeOfRun] = speed * speed.transpose() / (kSpeedScale_m_s * kSpeedScale_m_s);
  }
  return block;
}

/// The wind that the air at the vehicle means, mean by mean, against and across the + heading.
CoastdownData find_winds(const CoastdownData& data, const std::vector<TraceRun>& traces) {
  CoastdownData winds = data;
  for (const TraceRun& trace : traces) {
    CoastdownConditions& at = winds.runs[trace.index].conditions;
    at.wind_m_s.clear();
    at.crosswind_m_s.clear();
    for (std::size_t first = 0; first + trace.stretch <= trace.samples.size(); first += trace.stretch) {
      double along = 0.0, across = 0.0;
      for (std::size_t i = 0; i < trace.stretch; ++i) {
        const TraceSample& sample = trace.samples[first + i];
        const double share = trace.heading / static_cast<double>(trace.stretch);
        along += share * (sample.air.speed_m_s * std::cos(sample.air.yaw_rad) - sample.speed_m_s);
        across += share * sample.air.speed_m_s * std::sin(sample.air.yaw_rad);
      }
      at.wind_m_s.push_back(along);
      if (!at.yaw_rad.empty()) at.crosswind_m_s.push_back(across);
    }
  }
  return winds;
}

/// Whether every run says from where the air comes.
bool has_yaw(const CoastdownData& data, bool on_board) {
  return std::all_of(data.runs.begin(), data.runs.end(), [on_board](const CoastdownRun& run) {
    return !(on_board ? run.conditions.yaw_rad : run.conditions.crosswind_m_s).empty();
  });
}

/// Warns where the anemometers at the vehicle and beside the road contradict each other; whether they do.
bool do_anemometers_contradict(const CoastdownData& beside, const CoastdownData& on_board,
                               std::vector<std::string>& warnings) {
  bool contradict = false;
  struct Component {
    std::vector<double> CoastdownConditions::*values;
    const char* shown_by;
    const char* column;
  };
  for (const auto& [values, shown_by, column] :
       {Component{&CoastdownConditions::wind_m_s, "the anemometer at the vehicle shows a wind along the road of",
                  "wind_m_s"},
        Component{&CoastdownConditions::crosswind_m_s, "the anemometer at the vehicle shows a wind across the road of",
                  "crosswind_m_s"}}) {
    std::vector<RecordedAndShown> runs;
    for (std::size_t i = 0; i < beside.runs.size(); ++i) {
      const std::vector<double>& recorded = beside.runs[i].conditions.*values;
      const std::vector<double>& shown = on_board.runs[i].conditions.*values;
      if (recorded.empty() || shown.empty()) continue;
      runs.push_back({beside.runs[i].heading, beside.runs[i].session, calc_mean(recorded), calc_mean(shown)});
    }
    for (std::string& doubt : doubt_winds(runs, shown_by, column)) {
      warnings.push_back(std::move(doubt));
      contradict = true;
    }
  }
  return contradict;
}

constexpr double kDegPerRad = 57.29577951308232;

/// Warns of a vane that is off: what both headings have of yaw, which a wind across the road has with opposite signs.
void doubt_vane(const CoastdownData& data, const std::vector<TraceRun>& traces, std::vector<std::string>& warnings) {
  constexpr double kLeastOffset_rad = 2.0 / kDegPerRad;  // Assumed: a vane is mounted within 1 deg
  std::vector<RecordedAndShown> runs;
  for (const TraceRun& trace : traces) {
    double across = 0.0, whole = 0.0;
    for (const TraceSample& sample : trace.samples) {
      across += sample.air.speed_m_s * std::sin(sample.air.yaw_rad);
      whole += sample.air.speed_m_s;
    }
    runs.push_back({trace.heading, data.runs[trace.index].session, 0.0, across / whole});
  }
  const std::optional<double> offset_rad = find_contradiction(runs, kLeastOffset_rad);
  if (!offset_rad.has_value()) return;
  warnings.push_back(fmt::format(
      "yaw_deg is {:+.1f} deg on average of both headings, where a wind across the road has opposite signs: "
      "is the vane mounted at an angle, or has yaw_deg no sign?",
      *offset_rad * kDegPerRad));
}

/// Warns of yaw angles that are far below what the wind along the road makes likely: they are in rad and not in deg.
void doubt_yaw_unit(const CoastdownData& winds, const std::vector<TraceRun>& traces,
                    std::vector<std::string>& warnings) {
  constexpr double kLeastWind_m_s = 0.5;      // Assumed
  constexpr double kLeastShare = 1.0 / 15.0;  // Assumed: of the wind across in that along; of angles in rad it is 1/57
  double squares = 0.0, cross_squares = 0.0, n = 0.0;
  for (const TraceRun& trace : traces) {
    for (const TraceSample& sample : trace.samples) {
      const double across_m_s = sample.air.yaw_rad * sample.speed_m_s;
      squares += sample.air.yaw_rad * sample.air.yaw_rad;
      cross_squares += across_m_s * across_m_s;
      n += 1.0;
    }
  }
  const double yaw_rad = std::sqrt(squares / n);
  const double wind_m_s = find_common_wind(winds).value_or(0.0);
  const double across_m_s = std::sqrt(cross_squares / n);
  if (yaw_rad == 0.0 || wind_m_s < kLeastWind_m_s || across_m_s > kLeastShare * wind_m_s) return;
  warnings.push_back(fmt::format(
      "yaw_deg is {:.2f} deg (root of the mean square) though the wind along the road is {:.1f} m/s: a wind does not "
      "keep to the road like that. Are the angles in rad?",
      kDegPerRad * yaw_rad, wind_m_s));
}

/// Throws InputError where a heading has no run, or none that is long enough.
void require_traces_of_both_headings(const CoastdownData& data, const std::vector<TraceRun>& traces) {
  for (const int heading : {+1, -1}) {
    const auto is_it = [heading](const auto& run) { return run.heading == heading; };
    if (std::any_of(traces.begin(), traces.end(), is_it)) continue;
    if (std::none_of(data.runs.begin(), data.runs.end(), is_it)) {
      throw InputError({"all runs have the same heading, or none: the procedure pairs opposite ones", "", 0, "heading",
                        "", "a column heading with + and -, and runs of both", ""});
    }
    throw InputError({fmt::format("no run of the heading {} is long enough", heading > 0 ? "+" : "-"), "", 0, "time_s",
                      "",
                      fmt::format("runs that coast for {:g} s at least between the speeds of the fit",
                                  kFewestStretches * kStretch_s),
                      ""});
  }
}

/// Pairs of the runs in their order; those with a run above the limits of the wind are rejected.
std::vector<TraceRun> keep_pairs(const CoastdownData& data, std::vector<TraceRun> traces,
                                 const std::vector<std::string>& windy, std::vector<RoadLoadCheck>& checks,
                                 std::vector<std::string>& warnings) {
  constexpr std::size_t kFewest = 3;
  constexpr std::size_t kWanted = 5;
  require_traces_of_both_headings(data, traces);
  std::vector<const TraceRun*> ways[2];
  for (const TraceRun& trace : traces) {
    if (trace.heading != 0) ways[trace.heading > 0 ? 0 : 1].push_back(&trace);
  }
  std::vector<TraceRun> kept;
  const std::size_t pairs = std::min(ways[0].size(), ways[1].size());
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::string names[2] = {name_of_run(data.runs[ways[0][i]->index], data),
                                  name_of_run(data.runs[ways[1][i]->index], data)};
    const auto is_windy = [&windy](const std::string& name) {
      return std::find(windy.begin(), windy.end(), name) != windy.end();
    };
    if (is_windy(names[0]) || is_windy(names[1])) {
      warnings.push_back(
          fmt::format("the pair of runs {} and {} is rejected: its wind is above the limits", names[0], names[1]));
      continue;
    }
    kept.push_back(*ways[0][i]);
    kept.push_back(*ways[1][i]);
  }
  for (const auto& way : ways) {
    for (std::size_t i = pairs; i < way.size(); ++i) {
      warnings.push_back(fmt::format("run {} is not used: no run of the opposite heading goes with it",
                                     name_of_run(data.runs[way[i]->index], data)));
    }
  }
  if (kept.size() < 2 * kFewest) {
    throw InputError({fmt::format("fewer than {} pairs of opposite headings{}: {}", kFewest,
                                  kept.size() < 2 * pairs ? " within the limits of the wind" : "", kept.size() / 2),
                      "", 0, "heading", "",
                      kept.size() < 2 * pairs ? "at least three pairs, with winds in m/s; the procedures ask for five"
                                              : "at least three pairs; the procedures ask for five",
                      ""});
  }
  checks.push_back({"pairs", kept.size() >= 2 * kWanted ? CheckStatus::kPass : CheckStatus::kFail,
                    fmt::format("{}", kept.size() / 2), ">= 5",
                    "Regulation (EU) 2017/1151, 4.3.2.4 of Sub-Annex 4; SAE J1263"});
  return kept;
}

double find_widest_yaw(const std::vector<TraceRun>& traces) {
  double widest = 0.0;
  for (const TraceRun& trace : traces) {
    for (const TraceSample& sample : trace.samples) widest = std::max(widest, std::abs(sample.air.yaw_rad));
  }
  return widest;
}

/// Whether the runs have the air flow that the procedure needs.
bool require_air(const CoastdownData& data, const RoadLoadProcedureOptions& options) {
  bool on_board = true, beside = true, traces = true;
  for (const CoastdownRun& run : data.runs) {
    on_board = on_board && !run.conditions.air_speed_m_s.empty();
    beside = beside && !run.conditions.wind_m_s.empty();
    traces = traces && run.bins.empty();
  }
  if (!traces) {
    throw InputError({"times through speed bins: the procedure needs speed traces", "", 0, "v_hi_kmh", "",
                      "columns time_s and speed_km_h; or --method wltp", ""});
  }
  if (options.kind == RoadLoadProcedureKind::kJ2263 && !on_board && !beside) {
    throw InputError(
        {"no air speed: SAE J2263 measures the air flow at the vehicle", "", 0, "air_speed_km_h", "",
         "columns air_speed_km_h and yaw_deg, or wind_m_s and crosswind_m_s of a stationary anemometer; or "
         "--method j1263",
         ""});
  }
  return options.kind == RoadLoadProcedureKind::kJ2263 && on_board;
}

void put_estimate(const LinearEstimate& estimate, const TraceTerms& terms, const RoadLoadProcedureOptions& options,
                  RoadLoadProcedure& procedure) {
  const double reference_density =
      procedure.correction.reference_pressure_Pa / (kGasConstant_J_kgK * options.reference_temperature_K);
  const Index drag = terms.first_drag();
  MatrixXd pick = MatrixXd::Zero(3, terms.count());
  pick(0, 0) = 1.0;
  if (terms.has_B) pick(1, 1) = 1.0;
  pick(2, drag) = 0.5 * reference_density;
  procedure.road_load = pick * estimate.coefficients;
  procedure.corrected = procedure.road_load;
  procedure.repeatability = pick * estimate.covariance * pick.transpose();
  procedure.freedom = {estimate.degrees_freedom(0),
                       terms.has_B ? estimate.degrees_freedom(1) : std::numeric_limits<double>::infinity(),
                       estimate.degrees_freedom(drag)};
  const double rolling = procedure.correction.rolling_factor();
  procedure.as_tested = {procedure.road_load(0) / rolling, procedure.road_load(1) / rolling,
                         procedure.road_load(2) / procedure.correction.air_factor()};
  const auto sd_of = [&estimate](Index i) { return std::sqrt(estimate.covariance(i, i)); };
  constexpr const char* kYawKeys[] = {"drag_area_m2", "drag_area_m2_per_rad", "drag_area_m2_per_rad2",
                                      "drag_area_m2_per_rad3", "drag_area_m2_per_rad4"};
  for (int power = 0; power <= terms.yaw_degree; ++power) {
    procedure.further.push_back({kYawKeys[power],
                                 power == 0 ? "drag area at no yaw, m2" : fmt::format("times yaw^{}, m2", power),
                                 estimate.coefficients(drag + power), sd_of(drag + power)});
  }
  if (terms.has_slope) {
    const double weight_N = procedure.correction.mass_kg * kStandardGravity_m_s2;
    const Index at = terms.count() - 1;
    procedure.further.push_back(
        {"slope", "slope uphill in +, from the headings", estimate.coefficients(at) / weight_N, sd_of(at) / weight_N});
  }
  procedure.further.push_back(
      {"speed_sd_m_s", "scatter of a speed sample, m/s", std::sqrt(estimate.components(kSpeedNoise)), 0.0});
  procedure.further.push_back(
      {"run_to_run_N", "scatter from run to run, N", std::sqrt(estimate.components(kForceOfRun)), 0.0});
}

void put_session_scatter(const TraceFit& fit, RoadLoadProcedure& procedure) {
  if (fit.session_force_N > 0.0) {
    procedure.further.push_back(
        {"session_to_session_N", "scatter from session to session, N", fit.session_force_N, 0.0});
  }
  if (!fit.sessions_are_told) {
    procedure.warnings.push_back(
        "the sessions cannot be told from the headings or the speeds of their runs: how sessions differ is not in the "
        "intervals");
  }
  if (fit.session_share > 0.0) {
    procedure.further.push_back({"session_to_session_share", "scatter from session to session, as a share of the force",
                                 fit.session_share, 0.0});
  }
}

/// Runs as traces, cut to the speeds of the options; names of all runs go to the procedure.
std::vector<TraceRun> cut_traces(const CoastdownData& data, const RoadLoadProcedureOptions& options,
                                 RoadLoadProcedure& procedure) {
  const double reference_pressure_Pa = options.reference_pressure_Pa.value_or(kSaeAir.reference_pressure_Pa);
  std::vector<TraceRun> traces;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    TraceRun trace = cut_trace(data.runs[i], i, options, reference_pressure_Pa);
    if (trace.stretch > 0 && trace.samples.size() >= kFewestStretches * trace.stretch)
      traces.push_back(std::move(trace));
    procedure.run_names.push_back(name_of_run(data.runs[i], data));
  }
  return traces;
}

/// The winds of the runs, where those at the vehicle are calibrated by those beside the road; warns of what speaks
/// against them.
CoastdownData find_checked_winds(const CoastdownData& data, bool on_board, std::vector<TraceRun>& traces,
                                 RoadLoadProcedure& procedure) {
  if (!on_board) return data;
  require_one_speed_unit(traces);
  const bool contradict = do_anemometers_contradict(data, find_winds(data, traces), procedure.warnings);
  const bool is_calibrated = !contradict && calibrate_air(data, traces, procedure.warnings);
  procedure.tested.has_air_speed = !is_calibrated;  // else an error of the air speed cancels
  if (!is_calibrated && has_yaw(data, on_board)) doubt_vane(data, traces, procedure.warnings);
  return find_winds(data, traces);
}

TraceTerms choose_terms(const CoastdownData& data, const CoastdownData& winds, bool on_board,
                        const std::vector<TraceRun>& traces, const RoadLoadProcedureOptions& options,
                        RoadLoadProcedure& procedure) {
  TraceTerms terms;
  terms.has_B = options.kind == RoadLoadProcedureKind::kJ2263;
  terms.yaw_degree = options.kind == RoadLoadProcedureKind::kJ2263 ? options.yaw_degree : 0;
  terms.has_slope = !has_recorded_slopes(data);
  if (terms.yaw_degree == 0) return terms;
  if (on_board && has_yaw(data, on_board)) {
    std::vector<std::string> doubts;  // before those that follow from it
    doubt_yaw_unit(winds, traces, doubts);
    procedure.warnings.insert(procedure.warnings.begin(), doubts.begin(), doubts.end());
  }
  const double widest_rad = find_widest_yaw(traces);
  if (!has_yaw(data, on_board)) {
    terms.yaw_degree = 0;
    procedure.warnings.push_back(
        fmt::format("no column {}: the yaw angle was not measured and is taken as 0, the drag area is fitted as one "
                    "number, which holds the drag of a wind across the road",
                    on_board ? "yaw_deg" : "crosswind_m_s"));
  } else if (widest_rad < kLeastYaw_rad) {
    terms.yaw_degree = 0;
    procedure.warnings.push_back("the yaw angle stays below 1 deg: the drag area is fitted as one number");
  }
  return terms;
}

/// keep_pairs() within the limits of the wind; the conditions of the result are those of their runs.
std::vector<TraceRun> keep_calm_pairs(const CoastdownData& data, const CoastdownData& winds, bool on_board,
                                      std::vector<TraceRun> traces, const RoadLoadProcedureOptions& options,
                                      RoadLoadProcedure& procedure) {
  constexpr WindLimits kOnBoard{7.0, 10.0, 4.0, "UN GTR 15 Annex 4, 4.1.1.1.2", "yaw_deg"};
  constexpr WindLimits kStationary{16.0 / 3.6, 20.0 / 3.6, 8.0 / 3.6, "SAE J1263"};
  std::vector<RoadLoadCheck> checks;
  const std::vector<std::string> windy = check_winds(winds, on_board ? kOnBoard : kStationary, checks);
  check_slopes(data, checks);
  traces = keep_pairs(data, std::move(traces), windy, checks, procedure.warnings);
  std::vector<std::size_t> used;
  for (const TraceRun& trace : traces) used.push_back(trace.index);
  put_conditions(keep_runs(data, used), options, kSaeAir, procedure);
  procedure.checks.insert(procedure.checks.end(), checks.begin(), checks.end());
  procedure.wind_m_s = find_common_wind(keep_runs(winds, used));
  return traces;
}

RoadLoadProcedure evaluate_traces_once(const CoastdownFile& file, const RoadLoadProcedureOptions& options) {
  RoadLoadProcedure procedure;
  procedure.kind = options.kind;
  const bool on_board = require_air(file.data, options);
  put_masses(options, procedure);
  std::vector<TraceRun> traces = cut_traces(file.data, options, procedure);
  const CoastdownData winds = find_checked_winds(file.data, on_board, traces, procedure);
  if (!on_board && file.data.runs.front().conditions.wind_m_s.empty()) {
    procedure.warnings.push_back("no column wind_m_s: the runs count as in still air");
  }
  traces = keep_calm_pairs(file.data, winds, on_board, std::move(traces), options, procedure);
  const TraceTerms terms = choose_terms(file.data, winds, on_board, traces, options, procedure);
  const double mass_kg = procedure.correction.mass_kg;
  std::vector<LinearBlock> blocks;
  std::vector<std::string> sessions;
  for (const TraceRun& trace : traces) {
    sessions.push_back(file.data.runs[trace.index].session);
    blocks.push_back(make_trace_block(trace, terms, mass_kg, mass_kg + procedure.rotating_mass_kg));
  }
  const TraceFit fit = fit_trace_blocks(blocks, sessions);
  const LinearEstimate& estimate = fit.estimate;
  put_estimate(estimate, terms, options, procedure);
  put_session_scatter(fit, procedure);
  procedure.tested.measured = procedure.as_tested;
  procedure.tested.correction = procedure.correction;
  procedure.tested.correction.wind_m_s = 0.0;  // it is in the equation of motion
  if (!procedure.rotating_mass_assumed) procedure.tested.rotating_mass_kg = procedure.rotating_mass_kg;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const VectorXd fitted = blocks[k].X * estimate.coefficients;
    for (Index row = 0; row < fitted.size(); ++row) {
      const double speed_m_s = traces[k].samples[static_cast<std::size_t>(row + 1) * traces[k].stretch].speed_m_s;
      procedure.points.push_back({name_of_run(file.data.runs[traces[k].index], file.data), traces[k].heading, speed_m_s,
                                  blocks[k].y(row), fitted(row)});
    }
  }
  doubt_units(procedure);
  doubt_sessions(file.data, {}, procedure);
  add_warnings(doubt_session_units(file.data), procedure);
  doubt_recorded_conditions(winds, on_board ? "air_speed_km_h" : "wind_m_s", SlopeForce::kSubtracted, procedure);
  return procedure;
}

/// Change of the coefficients by an error of all vehicle speeds [1/(m/s)]: the same regression on speeds that have it.
/// With several sessions, both regressions take them as one, so that their scatter has the same shape in both.
Eigen::Vector3d find_change_by_speed(CoastdownFile file, const RoadLoadProcedureOptions& options,
                                     Eigen::Vector3d as_tested) {
  constexpr double kError_m_s = 0.2 / kKmhPerMs;
  const std::string session = file.data.runs.front().session;
  bool has_several = false;
  for (CoastdownRun& run : file.data.runs) {
    has_several = has_several || run.session != session;
    run.session = session;
  }
  if (has_several) as_tested = evaluate_traces_once(file, options).as_tested;
  for (CoastdownRun& run : file.data.runs) {
    for (double& speed_m_s : run.speed_m_s) speed_m_s += kError_m_s;
  }
  RoadLoadProcedureOptions moved = options;  // the same samples
  moved.speed_from_m_s += kError_m_s;
  moved.speed_to_m_s += kError_m_s;
  return (evaluate_traces_once(file, moved).as_tested - as_tested) / kError_m_s;
}

}  // namespace

RoadLoadProcedure evaluate_traces(const CoastdownFile& file, const RoadLoadProcedureOptions& options) {
  if (options.corrected_to_mass_kg.has_value()) {
    throw InputError({"SAE J2263 and SAE J1263 have no correction for the mass", "command line", 0, "--corrected-mass",
                      fmt::format("{:g}", *options.corrected_to_mass_kg),
                      "none; --method wltp and torque-meter correct for it", ""});
  }
  RoadLoadProcedure procedure = evaluate_traces_once(file, options);
  procedure.tested.by_speed = find_change_by_speed(file, options, procedure.as_tested);
  if (options.sensor_accuracy) procedure.sensors = list_sensor_contributions(procedure.tested);
  return procedure;
}

}  // namespace rollrig::estimation
