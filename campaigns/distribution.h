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

  /// The value below which the factor lies with a probability, as a setting takes it. Of a list, each value is equally
  /// likely.
  /// Validity  0 < probability < 1
  std::string calc_value(double probability) const;
};

/// The quantile of the standard normal distribution at a probability.
double calc_score(double probability);
/// The value of a normal factor at so many standard deviations above the mean.
std::string calc_normal_value(const Factor& factor, double score);

/// "key=uniform:LOW:HIGH" or "key=normal:MEAN:SD" as --draw has it. Throws InputError.
Factor read_drawn_factor(const std::string& text);

/// "normal", "uniform" or "values".
const char* name_of(Factor::Kind kind);

}  // namespace rollrig::campaigns
