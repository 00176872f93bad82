#pragma once
/// Virtual tests as the tools run them.

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scenarios/run/run_spec.h"

namespace rollrig::tools {

inline constexpr double kLowSpeed_m_s = 80.0 / 3.6;    // §3.3.1.2; notes: not 24.24
inline constexpr double kHighSpeed_m_s = 120.0 / 3.6;  // §3.3.1.2

/// The source's tires.
inline const std::array<std::string, 3> kTires{"a40", "a50", "a60"};

/// A quasi-static run of a scenario: `settings` as of --set, `more` further keys of a run document, such as "rig".
scenarios::RunSpec make_spec(const std::string& scenario, const std::string& tire,
                             const std::vector<std::string>& settings = {},
                             const std::map<std::string, std::string>& more = {});

/// The drive of §3.4.4: one undriven tire at 5400 N and 280 kPa.
scenarios::RunSpec make_source_drive(const std::string& tire);

/// A number of a result. Throws RunFailure where it could not be read off.
double number(const Json& result, const char* key);

/// Factor on a50's loss that gives this coefficient in the ISO test, for a tire of which only the class is known. A
/// tire with more loss runs warmer, so it is not the ratio of the coefficients.
double find_loss_factor(double rrc_N_per_kN);
/// Multiplies the loss of a tire.
void scale_loss(models::TireFile& tire, double factor);

/// Where `f` changes its sign between `low` and `high`.
double find_root(const std::function<double(double)>& f, double low, double high);

}  // namespace rollrig::tools
