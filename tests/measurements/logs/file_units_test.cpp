// Units that a log says of its columns.
#include "measurements/logs/file_units.h"

#include <catch2/catch.hpp>

#include "models/quantities.h"
#include "sim/core/error.h"

using namespace rollrig;
using namespace rollrig::measurements;

namespace {

LogForm make_unit_form(const std::string& unit) {
  LogColumn column;
  column.target = models::quantities::kSpeed;
  column.column = "v";
  column.unit = unit_of_key("v_" + unit);
  LogForm form;
  form.name = "torque_log";
  form.columns = {column};
  return form;
}

tables::LogTable make_table(const std::string& unit) {
  return {CsvTable::of_columns("a.mat", {"v"}, {{"80", "81"}}), {{"v", unit}}, {}};
}

}  // namespace

TEST_CASE("a column in another unit by the file than by the mapping is refused", "[fast]") {
  CHECK_NOTHROW(require_units(make_unit_form("km_h"), make_table("km/h")));
  CHECK_NOTHROW(require_units(make_unit_form("km_h"), make_table("furlong")));  // not known
  CHECK_THROWS_AS(require_units(make_unit_form("km_h"), make_table("m/s")), InputError);
  CHECK_THROWS_AS(require_units(make_unit_form("m_s"), make_table("N m")), InputError);
  LogForm scaled = make_unit_form("km_h");
  scaled.columns.front().factor = 3.6;
  CHECK_NOTHROW(require_units(scaled, make_table("m/s")));
}

TEST_CASE("units are understood as loggers write them", "[fast]") {
  for (const auto& [text, key] : {std::pair("km/h", "v_km_h"), std::pair("N m", "v_Nm"), std::pair("\u00b0C", "v_degC"),
                                  std::pair("kPa", "v_kPa"), std::pair("%", "v_percent")}) {
    INFO(text);
    REQUIRE(find_logged_unit(text).has_value());
    CHECK(find_logged_unit(text)->symbol == unit_of_key(key).symbol);
  }
  CHECK_FALSE(find_logged_unit("").has_value());
}
