#include "sim/core/random.h"

#include <random>
#include <vector>

namespace rollrig {

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)};
  for (const char c : name) words.push_back(static_cast<unsigned char>(c));
  std::seed_seq seeds(words.begin(), words.end());
  engine_.seed(seeds);
}

}  // namespace rollrig
