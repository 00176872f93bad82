#include "measurements/logs/clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "measurements/logs/thermal_response.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

InputError make_error(const Log& tire_log, const std::string& what, const std::string& value) {
  return InputError(
      {what, tire_log.file, 0, "[clock]", value,
       "a column that both logs have (speed_km_h, load_N), logs with changes of speed or load, or shift_s "
       "with shift_sd_s as measured",
       ""});
}

/// Rows of a channel that have a value.
Tie start_tie(const Log& log, const Quantity& channel) {
  Tie tie;
  tie.channel = channel;
  const std::vector<double>& values = log.columns.at(channel);
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row])) continue;
    tie.time_s.push_back(log.time_s[row]);
    tie.values.push_back(values[row]);
  }
  return tie;
}

/// Standard deviation of the values that are there.
double calc_spread(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (count == 0.0) first = value;
    sum += value - first;
    squares += (value - first) * (value - first);
    count += 1.0;
  }
  return count == 0.0 ? 0.0 : std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

std::vector<Tie> make_common_ties(const Log& torque_log, const Log& tire_log, const Mapping& mapping) {
  std::vector<Tie> ties;
  for (const auto& [channel, values] : torque_log.columns) {
    if (!tire_log.has(channel)) continue;
    Tie tie = start_tie(tire_log, channel);
    const Tie other = start_tie(torque_log, channel);
    if (tie.values.size() < 3 || other.values.size() < 3) continue;
    tie.is_common = true;
    tie.basis.node_s = other.time_s;
    tie.basis.functions = {other.values};
    if (channel == quantities::kLoad && mapping.clock.load_changes_at_rows) {
      // In each log a load holds from its row to the next: it is that of the middle between them.
      for (double& time_s : tie.basis.node_s) time_s += 0.5 * torque_log.interval_s;
      for (double& time_s : tie.time_s) time_s += 0.5 * tire_log.interval_s;
    }
    const double spread = calc_spread(tie.values);
    if (spread <= 0.0 || calc_spread(other.values) <= 0.0) continue;
    tie.noise = {0.0, 0.05 * spread, 60.0, 0.05 * spread, 0.0};  // where the search starts
    ties.push_back(std::move(tie));
  }
  return ties;
}

std::vector<Tie> make_response_ties(const Log& torque_log, const Log& tire_log, const Mapping& mapping) {
  std::vector<Tie> ties;
  if (!torque_log.has(quantities::kSpeed)) return ties;
  // The first that is there: what lies behind a second store answers with a lag of its own. Not the pressure: what the
  // gas and the volume add to it leaves shifts seconds apart alike.
  const std::pair<Quantity, Response> kinds[] = {{quantities::kLinerTemperature, Response::kRubber},
                                                 {quantities::kGasTemperature, Response::kGas}};
  for (const auto& [channel, response] : kinds) {
    if (!tire_log.has(channel) || !ties.empty()) continue;
    Tie tie = start_tie(tire_log, channel);
    if (tie.values.size() < 3 || calc_spread(tie.values) <= 0.0) continue;
    tie.basis = make_response_basis(torque_log, response, mapping.clock.load_changes_at_rows);
    tie.decay_s = response_decays_s(response);
    tie.noise = mapping.set.sensors.at(channel);
    tie.noise.offset_sd = 0.0;
    tie.noise.noise_sd = std::max(tie.noise.noise_sd, 1e-6 * calc_spread(tie.values));
    ties.push_back(std::move(tie));
  }
  return ties;
}

ClockPrior make_prior(const Log& torque_log, const Log& tire_log, const ClockPlan& plan) {
  ClockPrior prior;
  const bool both_alike = torque_log.is_absolute == tire_log.is_absolute;
  prior.center_s = both_alike ? 0.0 : torque_log.time_s.front() - tire_log.time_s.front();
  prior.half_width_s = plan.largest_shift_s;
  prior.rate_sd = plan.rate_sd;
  if (plan.shift_s.has_value()) {
    constexpr double kWide = 5.0;
    prior.center_s = *plan.shift_s;
    prior.shift_sd_s = *plan.shift_sd_s;
    prior.half_width_s = kWide * *plan.shift_sd_s;
  }
  return prior;
}

/// What speaks against a peak; empty when nothing does.
std::string judge_peak(const ClockPeak& peak, const std::vector<Tie>& ties, const ClockPrior& prior,
                       const ClockPlan& plan) {
  constexpr double kLeastGain = 12.0;  // e^12 : 1, against the many shifts that are tried
  constexpr double kClear = 6.0;       // e^6 : 1 against any other shift
  double chance = kLeastGain;
  for (const Tie& tie : ties) chance += 0.5 * static_cast<double>(tie.basis.functions.size());
  if (peak.gain < chance) return "the tire log follows nothing that the torque log knows";
  if (!(peak.shift_sd_s <= plan.largest_sd_s)) {
    return fmt::format("the shift of the clocks is known to no better than {:.3g} s (1 sd)", peak.shift_sd_s);
  }
  if (std::abs(peak.clock.shift_s - prior.center_s) > prior.half_width_s - peak.shift_sd_s) {
    return fmt::format("the likeliest shift lies at the end of the search, {:.1f} +- {:.1f} s", prior.center_s,
                       prior.half_width_s);
  }
  if (peak.gain - peak.gain_next < kClear) return "several shifts of the clocks agree with the logs as well";
  return {};
}

bool has_load_steps(const Log& log) {
  const auto found = log.columns.find(quantities::kLoad);
  return found != log.columns.end() && calc_spread(found->second) > 0.0;
}

/// How far a log's stamps lie from even steps, 1 sd of one stamp: their jitter, and the digits they are written with.
double find_stamp_sd(const Log& log) {
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t row = 1; row < log.time_s.size(); ++row) {
    const double departure_s = log.time_s[row] - log.time_s[row - 1] - log.interval_s;
    if (std::abs(departure_s) > 0.5 * log.interval_s) continue;  // a gap
    count += 1.0;
    sum += departure_s;
    squares += departure_s * departure_s;
  }
  if (count == 0.0) return 0.0;
  const double variance = squares / count - sum * sum / (count * count);
  return std::sqrt(0.5 * std::max(0.0, variance));  // a step has the errors of two stamps
}

/// What the logs' rows leave open of a step's time.
double find_sampling_sd(const std::vector<Tie>& ties, const Log& torque_log, const Log& tire_log,
                        const ClockPlan& plan) {
  const double stamps_s = std::hypot(find_stamp_sd(torque_log), find_stamp_sd(tire_log));
  if (plan.load_changes_at_rows) return stamps_s;
  double variance = stamps_s * stamps_s;
  for (const Tie& tie : ties) {
    const bool common_load = tie.channel == quantities::kLoad;
    if (!common_load && (tie.is_common || !has_load_steps(torque_log))) continue;
    const double rows_s2 =
        torque_log.interval_s * torque_log.interval_s + (common_load ? tire_log.interval_s * tire_log.interval_s : 0.0);
    variance = std::max(variance, stamps_s * stamps_s + rows_s2 / 12.0);
  }
  return std::sqrt(variance);
}

void fill_estimate(const ClockPeak& peak, const std::vector<Tie>& ties, const Mapping& mapping, ClockEstimate& to) {
  to.clock = peak.clock;
  to.statistical_sd_s = peak.shift_sd_s;
  to.rate_sd = peak.rate_sd;
  to.rate_is_decided = peak.rate_sd < 0.5 * mapping.clock.rate_sd;
  to.gain = peak.gain;
  to.gain_next = peak.gain_next;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    const TieFit& fit = peak.fits[i];
    const double explained = fit.count > 0 ? 1.0 - fit.chi2 / fit.chi2_alone : 0.0;
    to.evidence.push_back({ties[i].channel, ties[i].is_common, fit.count, explained});
  }
}

void require_comparable(const Log& torque_log, const Log& tire_log) {
  if (!torque_log.is_absolute || !tire_log.is_absolute || torque_log.is_utc == tire_log.is_utc) return;
  const Log& without = torque_log.is_utc ? tire_log : torque_log;
  throw InputError({"one log says its offset to UTC, the other does not", without.file, 0,
                    fmt::format("[{}.time]", without.form), "", "utc_offset_h = the hours ahead of UTC of its clock",
                    ""});
}

}  // namespace

double ClockEstimate::calc_shift_sd_s() const { return std::hypot(statistical_sd_s, sampling_sd_s, lag_sd_s); }

ClockEstimate estimate_clock(const Log& torque_log, const Log& tire_log, const Mapping& mapping) {
  require_comparable(torque_log, tire_log);
  const ClockPlan& plan = mapping.clock;
  const ClockPrior prior = make_prior(torque_log, tire_log, plan);
  ClockEstimate estimate;
  estimate.torque_log = torque_log.file;
  estimate.tire_log = tire_log.file;
  estimate.searched_from_s = prior.center_s - prior.half_width_s;
  estimate.searched_to_s = prior.center_s + prior.half_width_s;
  std::string objection = "the logs have nothing in common";
  for (const bool is_response : {false, true}) {
    const std::vector<Tie> ties = is_response ? make_response_ties(torque_log, tire_log, mapping)
                                              : make_common_ties(torque_log, tire_log, mapping);
    if (ties.empty()) continue;
    const ClockPeak peak = search_clock(ties, prior);
    objection = judge_peak(peak, ties, prior, plan);
    if (!objection.empty()) continue;
    estimate.method = is_response ? "response" : "common";
    fill_estimate(peak, ties, mapping, estimate);
    estimate.sampling_sd_s = find_sampling_sd(ties, torque_log, tire_log, plan);
    estimate.lag_sd_s = is_response ? plan.response_lag_sd_s : 0.0;
    return estimate;
  }
  if (!plan.shift_s.has_value()) throw make_error(tire_log, objection, "");
  estimate.method = "given";
  estimate.clock = {0.5 * (tire_log.time_s.front() + tire_log.time_s.back()), *plan.shift_s, 0.0};
  estimate.statistical_sd_s = *plan.shift_sd_s;
  estimate.rate_sd = plan.rate_sd;
  return estimate;
}

}  // namespace rollrig::measurements
