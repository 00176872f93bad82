#include "validation/generator/draws.h"

#include <algorithm>
#include <cmath>

namespace rollrig::generator {

std::uint64_t mix_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a over the name, then splitmix64 over both
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  hash ^= seed * 0x9e3779b97f4a7c15ull;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
  return hash ^ (hash >> 31);
}

int Draws::whole(int low, int high) {
  return std::min(high, low + static_cast<int>(std::floor(uniform() * (high - low + 1))));
}

double Draws::from(const Spread& spread) {
  if (spread.form == Spread::Form::kUniform) return uniform(spread.low, spread.high);
  const bool is_log = spread.form == Spread::Form::kLogNormal;
  const double low = is_log ? std::log(spread.low) : spread.low;
  const double high = is_log ? std::log(spread.high) : spread.high;
  const bool cut = spread.least < spread.most;
  for (;;) {
    const double drawn = 0.5 * (low + high) + 0.5 * (high - low) * normal();
    const double value = is_log ? std::exp(drawn) : drawn;
    if (!cut || (value >= spread.least && value <= spread.most)) return value;
  }
}

}  // namespace rollrig::generator
