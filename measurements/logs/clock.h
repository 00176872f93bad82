#pragma once
/// The clocks of a pair of logs.

#include <string>
#include <vector>

#include "measurements/logs/clock_search.h"
#include "measurements/logs/log.h"

namespace rollrig::measurements {

/// What one channel of the tire log had to say.
struct ClockEvidence {
  Quantity channel;
  bool is_common = false;  // measured by both logs; else a response of the tire
  std::size_t rows = 0;
  double explained = 0.0;  // share of what varies that follows the torque log
};

struct ClockEstimate {
  std::string torque_log;
  std::string tire_log;
  std::string method;  // "common", "response" or "given"
  Clock clock;
  double searched_from_s = 0.0;  // shifts
  double searched_to_s = 0.0;
  double statistical_sd_s = 0.0;
  double sampling_sd_s = 0.0;  // of stamps; and steps of the load lie anywhere between two rows
  double lag_sd_s = 0.0;       // of the tire's response, not told from a shift
  double rate_sd = 0.0;
  bool rate_is_decided = false;  // by the data: narrower than half of what was known before
  double gain = 0.0;
  double gain_next = 0.0;
  std::vector<ClockEvidence> evidence;

  double calc_shift_sd_s() const;
};

/// Shift and rate of the tire log's clock, from what both logs measure (speed, load, ambient, ...) or, where that does
/// not decide it, from how the liner temperature (else gas temperature) answers to speed and load.
/// Errors   InputError: nothing in common tells the clocks apart, several shifts do as well, the likeliest lies at the
///          end of the search, or the uncertainty is wider than the plan allows; unless the plan gives a shift
/// Checked  tests/measurements/logs/clock_test.cpp
ClockEstimate estimate_clock(const Log& torque_log, const Log& tire_log, const Mapping& mapping);

}  // namespace rollrig::measurements
