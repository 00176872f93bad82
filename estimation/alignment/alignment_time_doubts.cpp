#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "estimation/alignment/alignment_doubts.h"
#include "measurements/logs/time_stamps.h"
#include "models/tire/label_class.h"
#include "models/tire/tire_class.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr double kMinute_s = 60.0;
constexpr double kMostDaysBetween = 365.0;  // Assumed: tires age. From one machine's last to the other's first

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

/// All measurements on one machine, in the order of time.
std::vector<TimedMeasurement> list_timed(const AlignmentFile& file, TireMeasurements AlignmentTire::*side,
                                         bool has_controls) {
  std::vector<TimedMeasurement> timed;
  for (const AlignmentTire& tire : file.tires) add_timed(tire.name, (tire.*side).all, timed);
  if (has_controls) {
    for (const ControlTire& control : file.controls) add_timed(control.name, control.measurements, timed);
  }
  std::sort(timed.begin(), timed.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return timed;
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
  add_close_doubts(list_timed(file, &AlignmentTire::candidate, true), file.machine, least, doubts);
  add_close_doubts(list_timed(file, &AlignmentTire::reference, false), file.reference_machine, least, doubts);
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
  if (late == 0) return {};
  return {fmt::format("{} dated after today, {}, the last on {}: is the year right?",
                      late == 1 ? "1 measurement is" : fmt::format("{} measurements are", late), today,
                      format_day(last_s))};
}

}  // namespace rollrig::estimation
