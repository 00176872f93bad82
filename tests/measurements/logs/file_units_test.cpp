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
  CHECK_NOTHROW(require_units(make_unit_form("km_h"), make_table("bogus")));                  // not known
  CHECK_THROWS_AS(require_units(make_unit_form("km_h"), make_table("furlong")), InputError);  // a length
  CHECK_THROWS_AS(require_units(make_unit_form("km_h"), make_table("m/s")), InputError);
  CHECK_THROWS_AS(require_units(make_unit_form("m_s"), make_table("N m")), InputError);
  LogForm scaled = make_unit_form("km_h");
  scaled.columns.front().factor = 3.6;
  CHECK_NOTHROW(require_units(scaled, make_table("m/s")));
}

TEST_CASE("units are understood as loggers write them", "[fast]") {
  for (const auto& [text, suffix] : {std::pair("km/h", "km_h"), std::pair("kph", "km_h"), std::pair("N m", "Nm"),
                                     std::pair("N*m", "Nm"), std::pair("\u00b0C", "degC"),
                                     std::pair("\xb0"
                                               "C",
                                               "degC"),
                                     std::pair("C", "degC"), std::pair("kPa", "kPa"), std::pair("%", "percent")}) {
    INFO(text);
    CHECK_NOTHROW(require_units(make_unit_form(suffix), make_table(text)));
    CHECK_THROWS_AS(require_units(make_unit_form("kN"), make_table(text)), InputError);
  }
  CHECK_NOTHROW(require_units(make_unit_form("km_h"), make_table("")));
}
