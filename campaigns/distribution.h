#pragma once
/// What a factor of a campaign takes: the values of a list, or draws from a distribution.

#include <string>
#include <vector>

namespace rollrig::campaigns {

/// A setting that differs between the items of a campaign.
struct Factor {
  enum class Kind { kValues, kUniform, kNormal };

  std::string key;  // as in RunInput::settings
  Kind kind = Kind::kValues;
  std::vector<std::string> values = {};  // of kValues, at least one
  double first = 0.0;                    // kUniform: lower limit; kNormal: mean; in the unit of the key
  double second = 0.0;                   // kUniform: upper limit; kNormal: standard deviation

  /// The value at a share of the probability, as a setting takes it. For a list, each value has the same probability.
  /// Validity  0 < share < 1
  std::string calc_value(double share) const;
};

/// How many standard deviations above the mean a normal distribution has a share of its probability below it.
double calc_score(double share);
/// The value of a normal factor at so many standard deviations above the mean.
std::string calc_normal_value(const Factor& factor, double score);

/// "key=uniform:LOW:HIGH" or "key=normal:MEAN:SD" as --draw has it. Throws InputError.
Factor read_drawn_factor(const std::string& text);

/// "normal", "uniform" or "values".
const char* name_of(Factor::Kind kind);

}  // namespace rollrig::campaigns
