#include "estimation/alignment/alignment_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "measurements/logs/time_stamps.h"
#include "models/tire/label_class.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

// Assumed: all of these.
constexpr double kCopiedShare = 0.9;           // of the candidate's values that are used
constexpr double kCopiedMachineChance = 1e-4;  // that as many are equal without a copy
constexpr double kCopiedRoundChance = 0.01;    // that any two rounds are equal without a copy
constexpr std::size_t kLeastRoundTires = 3;

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

std::optional<std::string> doubt_copied_machine(const AlignmentFile& file) {
  if (file.reference_machine.empty()) return std::nullopt;
  const double different = 1.0 - count_equal_pairs(file).share();
  double values = 0.0, found = 0.0, found_by_chance = 0.0;
  for (const AlignmentTire& tire : file.tires) {
    std::set<double> reference;
    for (const AlignmentMeasurement& one : tire.reference.all) reference.insert(one.rrc_N_per_kN);
    const double by_chance = 1.0 - std::pow(different, static_cast<double>(reference.size()));
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

/// Equal values in successive rounds that are not equal as a whole.
EqualCount count_equal_values(const std::vector<TireRound>& rounds) {
  EqualCount count;
  for (std::size_t i = 1; i < rounds.size(); ++i) {
    if (rounds[i].values == rounds[i - 1].values) continue;
    for (const auto& [tire, value] : rounds[i].values) {
      const auto before = rounds[i - 1].values.find(tire);
      if (before == rounds[i - 1].values.end()) continue;
      ++count.of;
      if (before->second == value) ++count.equal;
    }
  }
  return count;
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
  const double equal = count_equal_values(rounds).share();
  const double pairs = 0.5 * static_cast<double>(rounds.size()) * (static_cast<double>(rounds.size()) - 1.0);
  std::map<std::map<std::string, double>, const TireRound*> seen;
  for (const TireRound& round : rounds) {
    const auto [before, is_new] = seen.emplace(round.values, &round);
    if (is_new || pairs * std::pow(equal, static_cast<double>(round.values.size())) > kCopiedRoundChance) continue;
    return fmt::format("{} have the same values{} on {} and on {}: real measurements scatter. Were they copied?",
                       format_count(round.values.size(), "tire"),
                       machine.empty() ? "" : fmt::format(" on machine '{}'", machine), show_days(*before->second),
                       show_days(round));
  }
  return std::nullopt;
}

std::optional<std::string> doubt_copied_rounds(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                               const std::string& machine) {
  const auto doubt = doubt_copied_round(list_rounds_by_order(file, side), machine);
  return doubt.has_value() ? doubt : doubt_copied_round(list_rounds_by_day(file, side), machine);
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
       {doubt_copied_machine(file), doubt_copied_rounds(file, &AlignmentTire::candidate, file.machine),
        doubt_copied_rounds(file, &AlignmentTire::reference, file.reference_machine)}) {
    if (doubt.has_value()) doubts.push_back(*doubt);
  }
  for (const std::string& doubt : list_class_doubts(file)) doubts.push_back(doubt);
  return doubts;
}

std::vector<std::string> list_date_doubts(const AlignmentFile& file, const std::string& today) {
  std::size_t late = 0;
  double last_s = 0.0;
  const auto look_at = [&](const std::vector<AlignmentMeasurement>& all) {
    for (const AlignmentMeasurement& one : all) {
      if (format_day(one.time_s - measurements::kDay_s) <= today) continue;
      ++late;
      last_s = std::max(last_s, one.time_s);
    }
  };
  for (const AlignmentTire& tire : file.tires) {
    look_at(tire.candidate.all);
    look_at(tire.reference.all);
  }
  for (const ControlTire& control : file.controls) look_at(control.measurements);
  if (late == 0) return {};
  return {fmt::format("{} dated after today, {}, the last on {}: is the year right?",
                      late == 1 ? "1 measurement is" : fmt::format("{} measurements are", late), today,
                      format_day(last_s))};
}

}  // namespace rollrig::estimation
