#pragma once
/// Sensitivities in words, as a table and as JSON.

#include <string>
#include <vector>

#include "campaigns/design.h"
#include "campaigns/sensitivity.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig {

struct Sensitivity {
  Json json;  // rollrig-sensitivity/1
  Table table;
  std::string explanation;         // of the table
  std::vector<std::size_t> order;  // the factors, the one that matters most first
};

Sensitivity describe_indices(const std::string& result, const campaigns::DesignInput& design,
                             const campaigns::SobolIndices& indices);
Sensitivity describe_effects(const std::string& result, const campaigns::DesignInput& design,
                             const campaigns::MorrisMeasures& measures);

}  // namespace rollrig
