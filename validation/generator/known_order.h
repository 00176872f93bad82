#pragma once
/// A case made anew from its truth.

#include <string>

#include "validation/generator/measurement_set.h"

namespace rollrig::generator {

/// The order that makes a case of `truth` anew.
/// Errors  InputError: no truth of this generator
SetOrder read_order(const Json& truth);

/// Errors  InputError: the files in `folder` are not those that the order makes
void require_same_files(const std::string& folder, const SetOrder& order);

}  // namespace rollrig::generator
