#pragma once
/// What a bank's truth says, once the seal may be opened.

#include <string>

#include "validation/generator/measurement_set.h"

namespace blind {

struct OpenedTruth {
  nlohmann::ordered_json sets;  // by number
  std::string sha256;           // of truth.json
};

/// Errors  InputError: no truth.json or seal.sha256; a truth that is not the sealed one
OpenedTruth open_truth(const std::string& bank);

/// The order that makes a set of `truth` anew. Errors  InputError
SetOrder read_order(const nlohmann::ordered_json& truth);

/// Errors  InputError: the files in `folder` are not those that the order makes
void require_same_files(const std::string& folder, const SetOrder& order);

}  // namespace blind
