#pragma once
/// What a user says about the kind of a set, checked.

#include <optional>
#include <string>
#include <vector>

#include "validation/generator/kind.h"

namespace blind {

/// Throws InputError where there is no such kind.
Kind read_kind(const std::string& name);

/// Campaigns of a bank: one of a kind, or all of "mixed". Throws InputError where there is no such kind.
std::vector<CampaignChoice> read_campaigns(const std::string& name);

/// Kinds, as a message names them.
std::string list_kinds(Grounds grounds);

/// Throws InputError where one of the effects has no place on a kind; with `drawn`, where banks do not have it.
void check_grounds(const std::vector<std::string>& ids, Kind kind, bool drawn);

/// Throws InputError where no bank has one of the effects.
void check_drawn_somewhere(const std::vector<std::string>& ids);

/// Whether the law of a road set is a constant coefficient, where that is said. Throws InputError.
std::optional<bool> read_baseline(const std::string& name, const std::vector<std::string>& ids, Kind kind);

}  // namespace blind
