#pragma once
/// Where the effects of a case truly change the readings, and whether an answer says so.

#include <string>
#include <vector>

#include "diagnosis/findings/locations.h"
#include "sim/core/json.h"

namespace rollrig::validation {

constexpr const char* kLocationsFile = "locations.json";  // in a validation set

/// A change of the readings in noise floors, of means over 10 s.
struct TrueChange {
  double mean = 0.0;
  double rms = 0.0;
};

/// A stretch in which an answer may locate the gap, and what the effects change there.
struct TruePlace {
  diagnosis::LocationStretch stretch;
  std::size_t blocks = 0;     // means
  TrueChange of_effects;      // before any recalibration
  TrueChange after_retuning;  // by one who knows no effect
};

/// Whether the parts of a named location are among those where the gap is largest.
struct LocationCheck {
  bool channel = false;
  bool run = false;    // of its channel
  bool phase = false;  // of its run and channel

  bool is_right() const { return channel && run && phase; }
};

/// Equation  q^2 = sum over stretches of blocks rms^2; the channel is right where q of it >= 0.8 of the largest q of a
///           channel, the run likewise among the runs within its channel, the phase among the phases of its run and
///           channel
/// Symbols   rms of the change after retuning; q^2 is a part of the gap, of which the answer states the share
/// Assumed   0.8
/// Errors    InputError: the location is no stretch of these
/// Checked   tests/validation/scoring/locations_test.cpp
LocationCheck check_largest(const diagnosis::Location& named, const std::vector<TruePlace>& places);

/// Whether the effects shift the readings of a named location as it says: after retuning or before it, to the same
/// side, by at least half the stated size.
/// Errors    InputError: the location is no stretch of these
/// Checked   tests/validation/scoring/locations_test.cpp
bool is_shifted(const diagnosis::Location& named, const std::vector<TruePlace>& places);

/// `sets` of rollrig-validation-locations/1, of one case.
Json make_places_json(const std::vector<TruePlace>& places);
/// Throws Json::exception where it is no such thing.
std::vector<TruePlace> read_places(const Json& json);

}  // namespace rollrig::validation
