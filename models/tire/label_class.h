#pragma once
/// The EU label's class of an RRc, and the limits of type approval.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "models/tire/tire_class.h"

namespace rollrig::models {

constexpr std::size_t kLabelClassCount = 5;
constexpr std::array<const char*, kLabelClassCount> kLabelClasses{"A", "B", "C", "D", "E"};

/// Coefficients that tires have [N/N]. What lies outside is a mistake in the unit. Assumed: these limits.
constexpr double kLowestTireRrc = 0.002;
constexpr double kHighestTireRrc = 0.030;

/// What is wrong with a coefficient that no tire has, and which unit it may be in.
struct RrcMistake {
  std::string what;
  std::string allowed;
};
std::optional<RrcMistake> find_rrc_mistake(double rrc);

/// An RRc [N/N] as it is declared: rounded to 0.1 N/kN, a half upwards.
/// Source    ISO 80000-1, B.3, rule B, which Regulation (EU) 2017/2400, Annex X, 3.2 asks for
double round_declared_rrc(double rrc);

/// Highest declared RRc [N/N] of the classes A to D; class E is above them.
/// Source    Regulation (EC) 1222/2009, Annex I, part A, where the last three classes of C1 and C2 are E, F and G, of C3
///           E and F. Regulation (EU) 2020/740, Annex I, part A has classes A to E at the same bounds, second-hand: its
///           annex was not read
/// Checked   tests/models/label_class_test.cpp
std::array<double, kLabelClassCount - 1> list_label_bounds(TireClass tire_class);

/// Place in kLabelClasses of the class that the declared RRc has.
std::size_t find_label_class(TireClass tire_class, double rrc);

/// Probability of each class where the RRc is known with a standard uncertainty [N/N], which may be 0.
/// Equation  P_k = Phi((b_k - c)/s) - Phi((b_(k-1) - c)/s), b_k the bound of the class plus 0.05 N/kN
/// Symbols   c RRc, s its standard uncertainty, Phi the normal distribution; half a step of rounding
std::array<double, kLabelClassCount> calc_label_probabilities(TireClass tire_class, double rrc, double rrc_sd);

/// Highest RRc of type approval at one stage [N/N].
struct RrcLimit {
  int stage = 0;
  double rrc = 0.0;
};

/// Limits of stages 1 and 2, 1 N/kN higher for tires for use in severe snow conditions.
/// Source    UN Regulation No. 117, 02 series, 6.3.1 and 6.3.2, and Regulation (EC) 661/2009, Annex II, part B,
///           second-hand: not read. The 04 series has other limits; they could not be read and are not here
std::vector<RrcLimit> list_rrc_limits(TireClass tire_class, bool is_severe_snow);

/// A question about the class of tires whose mean RRc [N/N] is above the limit of stage 1, or below 0.6 times the upper
/// bound of label class A; nothing where it is one of the class. Assumed: both, since sets of tires have a mean
/// between.
std::optional<std::string> doubt_class_by_mean(TireClass tire_class, double mean_rrc);

/// The same about one tire, whose RRc [N/N] is above 1.5 times the limit of stage 1, or as low as a doubted mean.
/// Assumed: 1.5
std::optional<std::string> doubt_class_by_rrc(TireClass tire_class, double rrc, bool is_severe_snow);

/// Standard deviation of repeated measurements that a laboratory may have at most [N/N]: 0.075 N/kN for C1 and C2, 0.06
/// N/kN for C3.
/// Source    Regulation (EU) 2020/740, Annex V, and UN Regulation No. 117, Annex 6, second-hand: not read
double get_highest_laboratory_sd(TireClass tire_class);

}  // namespace rollrig::models
