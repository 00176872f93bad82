#pragma once
/// What a user says about kind, effects, sizes and forms of cases, checked. All throw InputError.

#include <string>
#include <vector>

#include "validation/generator/validation_set.h"

namespace rollrig::generator {

constexpr const char* kNone = "none";

/// The effects of "a,b"; none of "none".
std::vector<std::string> read_effects(const std::string& list);

/// What make-case is told of its case.
struct CaseWords {
  std::string kind = all_machines().front()->word;
  std::string baseline;  // empty: drawn
  std::string effects = kNone;
  std::string sizes;  // empty: drawn
  std::string forms;  // empty: drawn
};
void read_case(const CaseWords& words, SetOrder& order);

/// Campaigns of a validation set: one of a kind, or all of "mixed".
std::vector<CampaignChoice> read_campaigns(const std::string& name);

/// List of effects outside of the catalog, by its name.
OutsideList read_outside_list(const std::string& name);

/// Whether effects are drawn where the order says.
void check_drawn(const ValidationSetOrder& order);

}  // namespace rollrig::generator
