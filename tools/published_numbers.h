#pragma once
/// The published numbers of the source's tires, as kept in tests/published.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig::tools {

/// Calls `read` with the reader of [name] in a file of published numbers, all of which it has to read. Throws
/// InputError.
void read_published_table(const std::string& path, const std::string& name,
                          const std::function<void(TableReader&)>& read);

/// What the source says of one tire; fractions, not percent.
struct PublishedTire {
  double rrc_iso = 0.0;                     // N/N
  std::optional<double> band_drop_percent;  // §4.1.6, over 30 to 35 degC
  std::optional<double> band_drop_N;
  double city_3_fall_K = 0.0;
  std::vector<double> city;            // Table 4.4, City 1 to 4
  std::vector<double> highway;         // Table 4.5, Highway 1 and 2
  std::vector<double> constant_speed;  // Table 4.5, 105 and 80 km/h
  double city_Wh_per_km = 0.0;         // Table 5.1
  double highway_Wh_per_km = 0.0;

  /// Sections in the order driven: city, highway, city, constant speed, twice.
  std::vector<double> sections() const;
};

/// Reads source.toml and table_4_4_and_4_5/expected.toml of `folder`. Throws InputError.
PublishedTire read_published_tire(const std::string& folder, const std::string& tire);

}  // namespace rollrig::tools
