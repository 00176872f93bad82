#include "estimation/run_checks/pooled_scatter.h"

#include <numeric>

namespace rollrig::estimation {

void PooledScatter::add_group(const std::vector<double>& values) {
  if (values.empty()) return;
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  degrees_of_freedom += count - 1.0;
}

}  // namespace rollrig::estimation
