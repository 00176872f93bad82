#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "estimation/alignment/alignment_doubts.h"
#include "measurements/logs/time_stamps.h"
#include "models/tire/label_class.h"
#include "models/tire/tire_class.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr double kMinute_s = 60.0;
constexpr double kMostDaysBetween = 365.0;  // Assumed: tires age. From one machine's last to the other's first
constexpr double kMostGapOfPart_days = 60.0;  // Assumed: between the measurements of some tires and the others
constexpr double kMostGap_days = 180.0;       // Assumed: between any two measurements, one after the other

/// Least times of a test [s].
struct LeastTestTimes {
  double soak_s = std::numeric_limits<double>::infinity();
  double warm_up_s = std::numeric_limits<double>::infinity();
};

/// The shortest of the classes of the file.
LeastTestTimes find_least_test_times(const AlignmentFile& file) {
  LeastTestTimes least;
  for (const AlignmentTire& tire : file.tires) {
    models::ServiceDescription service;
    service.tire_class = models::find_class_named(tire.tire_class).value_or(models::TireClass::kC1);
    service.load_index = models::kLowestLoadIndex;
    const models::IsoTestOfClass test = models::find_iso_test(service, 0.0);
    least.soak_s = std::min(least.soak_s, test.soak_s);
    least.warm_up_s = std::min(least.warm_up_s, test.warm_up_s);
  }
  return least;
}

/// A measurement on a machine, with its time of day.
struct TimedMeasurement {
  double time_s = 0.0;
  std::string tire;
};

void add_timed(const std::string& tire, const std::vector<AlignmentMeasurement>& all,
               std::vector<TimedMeasurement>& timed) {
  for (const AlignmentMeasurement& one : all) {
    if (std::fmod(one.time_s, measurements::kDay_s) != 0.0) timed.push_back({one.time_s, tire});
  }
}

void sort_timed(std::vector<TimedMeasurement>& measured) {
  std::stable_sort(measured.begin(), measured.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
}

/// All measurements on one machine that have a time of day, in the order of time.
std::vector<TimedMeasurement> list_timed(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                         const std::vector<ControlTire>& controls) {
  std::vector<TimedMeasurement> timed;
  for (const AlignmentTire& tire : file.tires) add_timed(tire.name, (tire.*side).all, timed);
  for (const ControlTire& control : controls) add_timed(control.name, control.measurements, timed);
  sort_timed(timed);
  return timed;
}

/// Measurements of alignment tires on one machine between two long gaps.
struct PartOfTime {
  std::vector<TimedMeasurement> measured;
  double gap_days = 0.0;  // the shorter one to the other parts

  std::size_t count_tires() const {
    std::set<std::string> tires;
    for (const TimedMeasurement& one : measured) tires.insert(one.tire);
    return tires.size();
  }
};

std::vector<PartOfTime> split_at_gaps(const std::vector<TimedMeasurement>& measured) {
  std::vector<PartOfTime> parts;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double gap_days = i == 0 ? std::numeric_limits<double>::infinity()
                                   : (measured[i].time_s - measured[i - 1].time_s) / measurements::kDay_s;
    if (gap_days > kMostGapOfPart_days) {
      if (i > 0) parts.back().gap_days = std::min(parts.back().gap_days, gap_days);
      parts.push_back({{}, gap_days});
    }
    parts.back().measured.push_back(measured[i]);
  }
  return parts;
}

/// The measurements that lie far from the others: of some of the tires, or of all of them by half a year, which is
/// longer than an alignment takes. The year or the month may be a wrong one.
void add_gap_doubts(const AlignmentFile& file, TireMeasurements AlignmentTire::*side, const std::string& machine,
                    std::vector<std::string>& doubts) {
  std::vector<TimedMeasurement> measured;
  for (const AlignmentTire& tire : file.tires) {
    for (const AlignmentMeasurement& one : (tire.*side).all) measured.push_back({one.time_s, tire.name});
  }
  sort_timed(measured);
  const std::vector<PartOfTime> parts = split_at_gaps(measured);
  const auto main = std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.measured.size() < b.measured.size();
  });
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    const bool has_all = part->count_tires() == file.tires.size();
    if (part == main || (has_all && part->gap_days <= kMostGap_days)) continue;
    doubts.push_back(fmt::format(
        "{}{}, the first of tire '{}' on {}, {} {:.0f} days from the others: {} right?",
        format_count(part->measured.size(), "measurement"),
        machine.empty() ? "" : fmt::format(" on machine '{}'", machine), part->measured.front().tire,
        format_day(part->measured.front().time_s), part->measured.size() == 1 ? "lies" : "lie", part->gap_days,
        part->measured.size() == 1 ? "is its date" : "are their dates"));
  }
}

/// Two measurements of a tire on one day, of which one has no time of day: which was the first is not known.
void add_day_doubts(const AlignmentFile& file, TireMeasurements AlignmentTire::*side, std::vector<std::string>& doubts) {
  for (const AlignmentTire& tire : file.tires) {
    const std::vector<AlignmentMeasurement>& all = (tire.*side).all;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const bool is_one_day = format_day(all[i].time_s) == format_day(all[i - 1].time_s);
      if (!is_one_day || all[i - 1].is_day_alone == all[i].is_day_alone) continue;
      doubts.push_back(fmt::format(
          "tire '{}' has two measurements on {}, one of them without a time of day, which is taken as the first: is "
          "it?",
          tire.name, format_day(all[i].time_s)));
    }
  }
}

/// Measurements that follow another one too soon.
struct ClosePairs {
  std::size_t count = 0;
  double least_s = std::numeric_limits<double>::infinity();
  TimedMeasurement closest;

  void add(const TimedMeasurement& later, double after_s) {
    ++count;
    if (after_s >= least_s) return;
    least_s = after_s;
    closest = later;
  }
};

/// Each measurement beside the one before it: of its own tire, or of another one.
ClosePairs find_close_pairs(const std::vector<TimedMeasurement>& timed, bool of_one_tire, double least_s) {
  ClosePairs close;
  for (std::size_t i = 1; i < timed.size(); ++i) {
    for (std::size_t k = i; k-- > 0 && timed[i].time_s - timed[k].time_s < least_s;) {
      if ((timed[i].tire == timed[k].tire) != of_one_tire) continue;
      close.add(timed[i], timed[i].time_s - timed[k].time_s);
      break;
    }
  }
  return close;
}

std::string describe_close_pairs(const ClosePairs& close, const std::string& machine, const std::string& before,
                                 const std::string& least) {
  return fmt::format("{}{} {} by less than {}; the least is {:.0f} min, of tire '{}' on {}",
                     format_count(close.count, "measurement"),
                     machine.empty() ? "" : fmt::format(" on machine '{}'", machine),
                     (close.count == 1 ? "follows " : "follow ") + before, least, close.least_s / kMinute_s,
                     close.closest.tire, format_day(close.closest.time_s));
}

void add_close_doubts(const std::vector<TimedMeasurement>& timed, const std::string& machine,
                      const LeastTestTimes& least, std::vector<std::string>& doubts) {
  const double soak_min = least.soak_s / kMinute_s, warm_up_min = least.warm_up_s / kMinute_s;
  if (const ClosePairs close = find_close_pairs(timed, true, least.soak_s + least.warm_up_s); close.count > 0) {
    doubts.push_back(describe_close_pairs(close, machine, "one of the same tire",
                                          fmt::format("{:.0f} min of soak and {:.0f} min of warm-up", soak_min,
                                                      warm_up_min)) +
                     ". Is each of them a test of its own?");
  }
  if (const ClosePairs close = find_close_pairs(timed, false, least.warm_up_s); close.count > 0) {
    doubts.push_back(describe_close_pairs(close, machine, "one of another tire",
                                          fmt::format("the {:.0f} min of a warm-up", warm_up_min)) +
                     ". Are the times right?");
  }
}

/// Days from the last measurement of one machine to the first of the other, where both have dates.
std::optional<std::string> doubt_days_between(const AlignmentFile& file) {
  if (file.reference_machine.empty()) return std::nullopt;
  double first_s = std::numeric_limits<double>::infinity(), last_s = -first_s;
  for (const AlignmentTire& tire : file.tires) {
    first_s = std::min(first_s, tire.reference.all.front().time_s);
    last_s = std::max(last_s, tire.reference.all.back().time_s);
  }
  const double days = std::max(first_s - file.last_s, file.first_s - last_s) / measurements::kDay_s;
  if (days <= kMostDaysBetween) return std::nullopt;
  return fmt::format("{:.0f} days lie between the measurements of the two machines, more than {:.0f}: tires age, and a "
                     "machine changes",
                     days, kMostDaysBetween);
}

}  // namespace

std::vector<std::string> list_time_doubts(const AlignmentFile& file) {
  std::vector<std::string> doubts;
  const LeastTestTimes least = find_least_test_times(file);
  add_close_doubts(list_timed(file, &AlignmentTire::candidate, file.controls), file.machine, least, doubts);
  add_close_doubts(list_timed(file, &AlignmentTire::reference, file.reference_controls), file.reference_machine, least,
                   doubts);
  add_gap_doubts(file, &AlignmentTire::candidate, file.machine, doubts);
  if (!file.reference_machine.empty()) {
    add_gap_doubts(file, &AlignmentTire::reference, file.reference_machine, doubts);
  }
  add_day_doubts(file, &AlignmentTire::candidate, doubts);
  add_day_doubts(file, &AlignmentTire::reference, doubts);
  if (const auto doubt = doubt_days_between(file); doubt.has_value()) doubts.push_back(*doubt);
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
  for (const ControlTire& control : file.reference_controls) look_at(control.measurements);
  if (late == 0) return {};
  return {fmt::format("{} dated after today, {}, the last on {}: is the year right?",
                      late == 1 ? "1 measurement is" : fmt::format("{} measurements are", late), today,
                      format_day(last_s))};
}

}  // namespace rollrig::estimation
