#pragma once
/// Limits of the alignment of laboratories by tire class.

#include <string>
#include <vector>

namespace rollrig::estimation {

/// Classes that are aligned together: C1 with C2, and C3 by itself.
/// Source  EU 2020/740 Annex V Section 5: one limit for C1 and C2, one for C3
struct AlignmentRules {
  std::string classes;           // "C1, C2"
  double sigma_m_N_per_kN;       // most, of a candidate; Section 5
  double gamma_N_per_kN;         // of the number of measurements; Section 5
  double least_range_N_per_kN;   // of the tires' RRc; Section 2.2. Second-hand
  std::size_t least_tires = 5;   // Section 1(4), Section 5
  std::size_t measurements = 4;  // of a tire, the first of which is not used; Section 5
  int years_valid = 2;           // "at least once every second year"; Section 5
  double reference_sigma_N_per_kN = 0.05;  // most, of a reference machine; Section 3. Second-hand
};

inline const AlignmentRules kRulesC1C2{"C1, C2", 0.075, 0.043, 3.0};
inline const AlignmentRules kRulesC3{"C3", 0.06, 0.035, 2.0};

inline const std::vector<std::string> kTireClasses{"C1", "C2", "C3"};

/// Days between two measurements of the control tires. Second-hand: UN R117 Annex 6, whose text was not at hand.
inline constexpr double kMostControlDays = 31.0;

/// How many measurements of each tire a machine of this sigma_m has to make, the first of which is not used.
///
/// Equation  n + 1 = 1 + (sigma_m/gamma)^2, rounded up, where sigma_m is above its limit; else 4
/// Source    EU 2020/740 Annex V Section 5
/// Checked   tests/estimation/alignment_test.cpp
std::size_t calc_measurements(const AlignmentRules& rules, double sigma_m_N_per_kN);

}  // namespace rollrig::estimation
