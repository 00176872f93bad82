#pragma once
/// In which inputs several runs differ, by their manifests.

#include <vector>

#include "include/rollrig/compare.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

/// Members of the documents that are not the same in all, by their dotted keys, in the order of the first document
/// that has them. Not listed are the members of the top level that `left_out` names, and of any level `file` and
/// `sha256`.
std::vector<DifferentInput> find_different_inputs(const std::vector<const Json*>& documents,
                                                  const std::vector<std::string>& left_out);

/// A manifest without what says nothing of the result: paths, hashes, versions, counts of the integrator.
Json strip_manifest(const Json& manifest);

}  // namespace rollrig::comparison
