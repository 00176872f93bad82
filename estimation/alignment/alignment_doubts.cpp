#include "estimation/alignment/alignment_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "measurements/logs/time_stamps.h"
#include "models/tire/label_class.h"
#include "sim/core/limits.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

// Assumed: all of these.
constexpr double kCopiedShare = 0.9;           // of the candidate's values that are used
constexpr double kCopiedMachineChance = 1e-4;  // that as many are equal without a copy
constexpr double kCopiedRoundChance = 0.01;    // that any two rounds are equal without a copy
constexpr double kCopiedMeansChance = 1e-3;    // that as many values are the candidate's means without a copy
constexpr double kTooNearLevel = 1e-4;         // of significance of tires that are too near to their line
constexpr double kPairedLevel = 1e-6;          // of significance of values that scatter together
constexpr double kCoarseStep_N_per_kN = 0.05;  // of values; sigma_m is of this order
constexpr std::size_t kLeastRoundTires = 3;
constexpr std::size_t kLeastTireValues = 3;

/// Values that the tires have in one round, by tire.
struct TireRound {
  std::map<std::string, double> values;
  double first_s = 0.0, last_s = 0.0;

  void add(const std::string& tire, const AlignmentMeasurement& one) {
    first_s = values.empty() ? one.time_s : std::min(first_s, one.time_s);
    last_s = values.empty() ? one.time_s : std::max(last_s, one.time_s);
    values.emplace(tire, one.rrc_N_per_kN);
  }
};

/// How many of so many values are equal.
struct EqualCount {
  std::size_t of = 0, equal = 0;

  /// As if one were equal where none is: a few values do not show that equal ones never happen.
  double share() const {
    if (of == 0) return 1.0;
    return static_cast<double>(std::max<std::size_t>(equal, 1)) / static_cast<double>(of);
  }

  /// The chance that so many more are all equal, of a share of which only this count is known.
  /// Equation  prod_(k < n) (equal + 1 + k)/(of + 2 + k): every share is equally probable before the count
  double calc_chance_of_all(std::size_t n) const {
    double chance = 1.0;
    for (std::size_t k = 0; k < n; ++k) chance *= static_cast<double>(equal + 1 + k) / static_cast<double>(of + 2 + k);
    return chance;
  }
};

/// Equal values among all pairs of measurements of one tire on one machine: by chance where values are coarse.
EqualCount count_equal_pairs(const AlignmentFile& file) {
  EqualCount count;
  for (const AlignmentTire& tire : file.tires) {
    for (const TireMeasurements* side : {&tire.candidate, &tire.reference}) {
      std::map<double, std::size_t> seen;
      for (std::size_t i = 0; i < side->all.size(); ++i) {
        count.of += i;
        count.equal += seen[side->all[i].rrc_N_per_kN]++;
      }
    }
  }
  return count;
}

/// The chance that at least so many of n happen, each with probability p.
double calc_binomial_tail(double n, double p, double least) {
  if (least <= 0.0 || p >= 1.0) return 1.0;
  return boost::math::cdf(boost::math::complement(boost::math::binomial_distribution<double>(n, p), least - 1.0));
}

/// The chance that a value stands among one other value of its tire, by how many values of a machine stand among the
/// others of their tire on this machine. Not by pairs: where coarse values have few steps, most values stand there,
/// though few pairs are equal.
double calc_chance_among_others(const AlignmentFile& file) {
  EqualCount among;
  double others = 0.0;
  for (const AlignmentTire& tire : file.tires) {
    for (const TireMeasurements* side : {&tire.candidate, &tire.reference}) {
      std::map<double, std::size_t> times;
      for (const AlignmentMeasurement& one : side->all) ++times[one.rrc_N_per_kN];
      if (side->all.size() < 2) continue;
      for (const auto& [value, count] : times) {
        among.of += count;
        among.equal += count > 1 ? count : 0;
        others += static_cast<double>(count * (side->all.size() - 1));
      }
    }
  }
  if (among.of == 0) return 1.0;
  return 1.0 - std::pow(1.0 - among.share(), static_cast<double>(among.of) / others);
}

std::optional<std::string> doubt_copied_machine(const AlignmentFile& file) {
  if (file.reference_machine.empty()) return std::nullopt;
  const double different = 1.0 - calc_chance_among_others(file);
  double values = 0.0, found = 0.0, found_by_chance = 0.0;
  for (const AlignmentTire& tire : file.tires) {
    std::set<double> reference;
    for (const AlignmentMeasurement& one : tire.reference.all) reference.insert(one.rrc_N_per_kN);
    const double by_chance = 1.0 - std::pow(different, static_cast<double>(tire.reference.all.size()));
    for (const double value : tire.candidate.used()) {
      values += 1.0;
      found += reference.count(value) > 0 ? 1.0 : 0.0;
      found_by_chance += by_chance;
    }
  }
  if (found < kCopiedShare * values) return std::nullopt;
  if (calc_binomial_tail(values, found_by_chance / values, found) > kCopiedMachineChance) return std::nullopt;
  return fmt::format(
      "{:.0f} of the {:.0f} used values of machine '{}' are equal to values of the same tire on machine '{}': were "
      "they copied?",
      found, values, file.machine, file.reference_machine);
}

std::vector<TireRound> list_rounds_by_order(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::vector<TireRound> rounds;
  for (const AlignmentTire& tire : file.tires) {
    const std::vector<AlignmentMeasurement>& all = (tire.*side).all;
    if (rounds.size() < all.size()) rounds.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) rounds[i].add(tire.name, all[i]);
  }
  return rounds;
}

std::vector<TireRound> list_rounds_by_day(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::map<double, TireRound> by_day;
  for (const AlignmentTire& tire : file.tires) {
    for (const AlignmentMeasurement& one : (tire.*side).all) {
      by_day[std::floor(one.time_s / measurements::kDay_s)].add(tire.name, one);
    }
  }
  std::vector<TireRound> rounds;
  for (const auto& [day, round] : by_day) rounds.push_back(round);
  return rounds;
}

/// Equal values of each tire in any two rounds that are not equal as a whole.
EqualCount count_equal_values(const std::vector<TireRound>& rounds) {
  std::set<std::map<std::string, double>> different;
  for (const TireRound& round : rounds) different.insert(round.values);
  EqualCount count;
  for (auto later = different.begin(); later != different.end(); ++later) {
    for (auto earlier = different.begin(); earlier != later; ++earlier) {
      for (const auto& [tire, value] : *later) {
        const auto before = earlier->find(tire);
        if (before == earlier->end()) continue;
        ++count.of;
        if (before->second == value) ++count.equal;
      }
    }
  }
  return count;
}

std::string show_on_machine(const std::string& machine) {
  return machine.empty() ? "" : fmt::format(" on machine '{}'", machine);
}

std::string show_days(const TireRound& round) {
  const std::string first = format_day(round.first_s), last = format_day(round.last_s);
  return first == last ? first : fmt::format("{} to {}", first, last);
}

/// The first round that has the values of an earlier one.
std::optional<std::string> doubt_copied_round(std::vector<TireRound> rounds, const std::string& machine) {
  rounds.erase(std::remove_if(rounds.begin(), rounds.end(),
                              [](const TireRound& round) { return round.values.size() < kLeastRoundTires; }),
               rounds.end());
  const EqualCount equal = count_equal_values(rounds);
  const double pairs = 0.5 * static_cast<double>(rounds.size()) * (static_cast<double>(rounds.size()) - 1.0);
  std::map<std::map<std::string, double>, const TireRound*> seen;
  for (const TireRound& round : rounds) {
    const auto [before, is_new] = seen.emplace(round.values, &round);
    if (is_new || pairs * equal.calc_chance_of_all(round.values.size()) > kCopiedRoundChance) continue;
    return fmt::format("{} have the same values{} on {} and on {}: real measurements scatter. Were they copied?",
                       format_count(round.values.size(), "tire"), show_on_machine(machine), show_days(*before->second),
                       show_days(round));
  }
  return std::nullopt;
}

std::optional<std::string> doubt_copied_rounds(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                               const std::string& machine) {
  const auto doubt = doubt_copied_round(list_rounds_by_order(file, side), machine);
  return doubt.has_value() ? doubt : doubt_copied_round(list_rounds_by_day(file, side), machine);
}

std::vector<double> list_values(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::vector<double> values;
  for (const AlignmentTire& tire : file.tires) {
    for (const AlignmentMeasurement& one : (tire.*side).all) values.push_back(one.rrc_N_per_kN);
  }
  return values;
}

std::optional<std::string> doubt_equal_values(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                              const std::string& machine) {
  for (const AlignmentTire& tire : file.tires) {
    const std::vector<double> values = (tire.*side).used();
    if (values.size() < 2) return std::nullopt;
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    if (*least != *greatest) return std::nullopt;
  }
  return describe_equal_values(fmt::format("all measurements of each tire{}", show_on_machine(machine)),
                               list_values(file, side));
}

std::vector<double> list_in_order(const TireMeasurements& measured) {
  std::vector<double> values;
  for (const AlignmentMeasurement& one : measured.all) values.push_back(one.rrc_N_per_kN);
  return values;
}

/// Tires that have the values of an earlier one, in the same order.
std::vector<std::string> doubt_copied_tires(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                            const std::string& machine) {
  const double equal = count_equal_pairs(file).share();
  const double tires = static_cast<double>(file.tires.size());
  const double pairs = 0.5 * tires * (tires - 1.0);
  std::map<std::vector<double>, std::string> seen;
  std::vector<std::string> doubts;
  for (const AlignmentTire& tire : file.tires) {
    const std::vector<double> values = list_in_order(tire.*side);
    if (values.size() < kLeastTireValues) continue;
    const auto [before, is_new] = seen.emplace(values, tire.name);
    if (is_new || pairs * std::pow(equal, static_cast<double>(values.size())) > kCopiedRoundChance) continue;
    doubts.push_back(fmt::format("tire '{}' has the {} values of tire '{}'{}: were they copied?", tire.name,
                                 values.size(), before->second, show_on_machine(machine)));
  }
  return doubts;
}

/// The chance that a value of the reference is the candidate's mean within its rounding, on two machines that measure
/// alike.
double calc_chance_of_mean(double tolerance, const RepeatScatter& repeats) {
  const double sd = std::hypot(repeats.candidate_sd, repeats.reference_sd);
  if (!(sd > 0.0)) return 1.0;
  return 1.0 - 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), tolerance / sd));
}

std::optional<std::string> doubt_copied_means(const AlignmentFile& file, const RepeatScatter& repeats) {
  constexpr double kRounding_N_per_kN = 1e-6;  // of a mean that is written with all its digits
  const double tolerance = 0.5 * find_reference_step(file) + kRounding_N_per_kN;
  const double of_chance = std::max(tolerance, 0.5 * find_greatest_step(list_values(file, &AlignmentTire::candidate)));
  const double count = static_cast<double>(file.tires.size());
  for (const bool only_used : {true, false}) {
    double found = 0.0;
    for (const AlignmentTire& tire : file.tires) {
      const std::vector<double> values = only_used ? tire.candidate.used() : list_in_order(tire.candidate);
      const double mean =
          std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
      found += std::abs(tire.reference_N_per_kN - mean) <= tolerance ? 1.0 : 0.0;
    }
    if (found < kCopiedShare * count) continue;
    if (calc_binomial_tail(count, calc_chance_of_mean(of_chance, repeats), found) > kCopiedMeansChance) continue;
    return fmt::format(
        "{:.0f} of the {:.0f} values of the reference{} are the means of the candidate's own measurements: were they "
        "copied?",
        found, count, show_on_machine(file.reference_machine));
  }
  return std::nullopt;
}

/// Whether the values of one side scatter by so many steps that means of different tires do not fall on one line by
/// their rounding alone.
bool is_fine(const AlignmentFile& file, TireMeasurements AlignmentTire::*side, double mean_sd) {
  constexpr double kLeastSteps = 2.0;  // Assumed; five tires then lie on one line by rounding in fewer than 1 of 10,000
  const std::vector<double> values = list_values(file, side);
  std::size_t fewest = (file.tires.front().*side).used().size();
  for (const AlignmentTire& tire : file.tires) fewest = std::min(fewest, (tire.*side).used().size());
  return values.empty() || mean_sd * std::sqrt(static_cast<double>(fewest)) >= kLeastSteps * find_greatest_step(values);
}

/// How the measurements of both machines scatter together about the means of their tires, paired by their order.
struct PairedScatter {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double freedom = -1.0;  // of the correlation

  void add(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() != y.size() || x.size() < 2) return;
    const double count = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mean_x) * (x[i] - mean_x);
      xy += (x[i] - mean_x) * (y[i] - mean_y);
      yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    freedom += count - 1.0;
  }
  double correlation() const { return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0; }
  /// Probability of so large a correlation of values that have none.
  double p_value() const {
    constexpr double kLeastRest = 1e-12;
    const double r = correlation();
    if (freedom < 3.0 || r <= 0.0) return 1.0;
    const double t = r * std::sqrt(freedom / std::max(kLeastRest, 1.0 - r * r));
    return boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), t));
  }
};

/// Measurements that were made on two machines scatter independently of each other.
std::optional<std::string> doubt_paired_values(const AlignmentFile& file) {
  PairedScatter paired;
  for (const AlignmentTire& tire : file.tires) paired.add(list_in_order(tire.candidate), list_in_order(tire.reference));
  if (paired.p_value() >= kPairedLevel) return std::nullopt;
  return fmt::format(
      "the measurements of the two machines scatter together, each with that of the same place in their order "
      "(correlation {:.4f}): were the values of one machine computed from those of the other?",
      paired.correlation());
}

std::optional<std::string> doubt_near_line(const LineFit& fit, const RepeatScatter& repeats) {
  const double repeat_sd = std::hypot(repeats.reference_sd, fit.slope * repeats.candidate_sd);
  const double p = calc_too_near_p(fit, repeat_sd, repeats.degrees_of_freedom);
  if (p >= kTooNearLevel) return std::nullopt;
  return fmt::format(
      "the tires lie within {:.5f} N/kN of the line, much nearer than the {:.3f} N/kN by which the repeats scatter (p = "
      "{:.1g}): were the values of one machine computed from those of the other?",
      fit.residual_sd, repeat_sd, p);
}

/// Doubts of each class of the file, by the mean of its tires.
std::vector<std::string> list_class_doubts(const AlignmentFile& file) {
  constexpr double kRatioPer_N_per_kN = 1e-3;
  std::map<std::string, std::vector<double>> means;
  for (const AlignmentTire& tire : file.tires) means[tire.tire_class].push_back(tire.candidate.mean());
  std::vector<std::string> doubts;
  for (const auto& [name, values] : means) {
    const auto tire_class = models::find_class_named(name);
    if (!tire_class.has_value()) continue;
    const double mean_N_per_kN =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    const auto doubt = models::doubt_class_by_mean(*tire_class, kRatioPer_N_per_kN * mean_N_per_kN);
    if (doubt.has_value()) doubts.push_back(*doubt);
  }
  return doubts;
}

}  // namespace

std::vector<std::string> list_value_doubts(const AlignmentFile& file) {
  std::vector<std::string> doubts;
  for (const auto& doubt :
       {doubt_equal_values(file, &AlignmentTire::candidate, file.machine),
        doubt_equal_values(file, &AlignmentTire::reference, file.reference_machine),
        doubt_copied_machine(file), doubt_copied_rounds(file, &AlignmentTire::candidate, file.machine),
        doubt_copied_rounds(file, &AlignmentTire::reference, file.reference_machine)}) {
    if (doubt.has_value()) doubts.push_back(*doubt);
  }
  for (const std::string& doubt : doubt_copied_tires(file, &AlignmentTire::candidate, file.machine)) {
    doubts.push_back(doubt);
  }
  for (const std::string& doubt : doubt_copied_tires(file, &AlignmentTire::reference, file.reference_machine)) {
    doubts.push_back(doubt);
  }
  for (const std::string& doubt : list_class_doubts(file)) doubts.push_back(doubt);
  return doubts;
}

std::vector<std::string> list_line_doubts(const AlignmentFile& file, const LineFit& fit, const RepeatScatter& repeats) {
  std::vector<std::string> doubts;
  if (is_fine(file, &AlignmentTire::candidate, repeats.candidate_sd) &&
      is_fine(file, &AlignmentTire::reference, repeats.reference_sd)) {
    const auto paired = doubt_paired_values(file), near = doubt_near_line(fit, repeats);
    if (paired.has_value() || near.has_value()) doubts.push_back(paired.has_value() ? *paired : *near);
  }
  if (const auto doubt = doubt_copied_means(file, repeats); doubt.has_value()) doubts.push_back(*doubt);
  return doubts;
}

std::string describe_equal_values(const std::string& subject, const std::vector<double>& values) {
  const double step = find_value_step(values);
  if (!is_at_least(step, kCoarseStep_N_per_kN)) {
    return fmt::format("{} are equal: real measurements scatter. Were they copied?", subject);
  }
  return fmt::format(
      "{} are equal: a step of {:g} N/kN is too coarse to show their scatter. State more digits; the uncertainty has "
      "the rounding, {:.3f} N/kN",
      subject, step, calc_rounding_sd(step));
}

}  // namespace rollrig::estimation
