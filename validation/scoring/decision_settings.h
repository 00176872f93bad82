#pragma once
/// What decides what a diagnosis says: recorded with each validation set, so that a release can be checked against it.

#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::validation {

/// The numbers of diagnosis/thresholds.h by name.
Json list_thresholds();

/// All thresholds, and of each effect its priors with their ranges and the error of its law, as this program has them.
/// rollrig-validation-settings/1.
Json list_decision_settings();

struct SettingsComparison {
  std::vector<std::string> changes;      // of what was there then, by name
  std::vector<std::string> new_effects;  // which ask for no new validation set
};

/// Checked  tests/validation/scoring/decision_settings_test.cpp
SettingsComparison compare_settings(const Json& recorded, const Json& now);

/// The record in a file.
/// Errors  InputError: no such record
Json read_settings(const std::string& file);

}  // namespace rollrig::validation
