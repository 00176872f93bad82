#include "tools/published_numbers.h"

namespace rollrig::tools {

void read_published_table(const std::string& path, const std::string& name,
                          const std::function<void(TableReader&)>& read) {
  const ConfigTable config = read_config(path);
  TableReader file(config, "");
  check_format(file, "rollrig-published", 1);
  const ConfigTable* table = file.table(name);
  if (table == nullptr) throw file.problem(name, "nothing is published of this tire");
  TableReader reader(*table, "[" + name + "]");
  read(reader);
  reader.finish();
}

std::vector<double> PublishedTire::sections() const {
  std::vector<double> all;
  for (std::size_t half = 0; half < 2; ++half) {
    all.insert(all.end(), {city.at(2 * half), highway.at(half), city.at(2 * half + 1), constant_speed.at(half)});
  }
  return all;
}

PublishedTire read_published_tire(const std::string& folder, const std::string& tire) {
  PublishedTire out;
  read_published_table(folder + "/source.toml", tire, [&out](TableReader& reader) {
    out.rrc_iso = reader.number({"rrc_iso_N_per_kN", positive(), ""});
    out.band_drop_percent = reader.number_or_none({"band_drop_percent", positive(), ""});
    out.band_drop_N = reader.number_or_none({"band_drop_N", positive(), ""});
    out.city_3_fall_K = reader.number({"city_3_fall_K", positive(), ""});
  });
  read_published_table(folder + "/table_4_4_and_4_5/expected.toml", tire, [&out](TableReader& reader) {
    out.city = reader.numbers_or({"city_percent", any_number(), ""}, {});
    out.highway = reader.numbers_or({"highway_percent", any_number(), ""}, {});
    out.constant_speed = reader.numbers_or({"constant_speed_percent", any_number(), ""}, {});
  });
  read_published_table(folder + "/table_5_1/expected.toml", tire, [&out](TableReader& reader) {
    out.city_Wh_per_km = reader.number({"city", positive(), ""});
    out.highway_Wh_per_km = reader.number({"highway", positive(), ""});
    for (const char* other : {"overall", "iso", "difference_percent"}) reader.number({other, any_number(), ""});
  });
  return out;
}

}  // namespace rollrig::tools
