#pragma once
/// What is true of the cases of a validation set.

#include <limits>
#include <string>
#include <vector>

namespace rollrig::validation {

/// An effect that a case has.
struct TrueEffect {
  std::string id;
  double size = std::numeric_limits<double>::quiet_NaN();
  double neutral = 0.0;  // size at which it does nothing; infinite where that is none
  std::string unit;
  std::string size_class;  // "" where the validation set has no classes
};

struct Truth {
  std::string number;
  std::vector<TrueEffect> effects;  // none, one, or two
  std::string kind;                 // of measurement set
  std::string campaign;             // kind of campaign, or kind of measurement set
  double signal_floors = 0.0;       // of the channel that shows most, in noise floors
  bool outside = false;             // not in the catalog

  /// "none", or the effects joined by "+".
  std::string name() const;
  std::vector<std::string> ids() const;
  /// Whether there are effects, and all of them are among `named`.
  bool is_within(const std::vector<std::string>& named) const;
};

/// The truth of all cases of a validation set.
/// Errors  InputError: as open_truth(); not of this set's cases; a case whose files are not those whose hash stands in
///         the truth
std::vector<Truth> read_truths(const std::string& set, const std::string& hash);

}  // namespace rollrig::validation
