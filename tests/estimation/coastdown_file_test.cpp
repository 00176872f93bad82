#include "estimation/road_load/coastdown_file.h"

#include <catch2/catch.hpp>

#include "sim/core/error.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using estimation::CoastdownFile;
using estimation::read_coastdowns;

namespace {

CoastdownFile read_text(const std::string& text) {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("coast.csv"), text);
  return read_coastdowns(folder.file("coast.csv"));
}

}  // namespace

TEST_CASE("a trace is read in SI units, run by run", "[fast]") {
  const CoastdownFile file = read_text(
      "time_s,speed_km_h,run,heading,ambient_degC,ambient_pressure_kPa,wind_m_s,slope\n"
      "0,36,1,+,15,99,1.5,0.001\n1,35,1,+,15,99,1.5,0.001\n2,33,1,+,15,99,1.5,0.001\n"
      "0,36,2,-,16,99,1,0.001\n1,34,2,-,16,99,1,0.001\n");
  CHECK(file.is_trace);
  REQUIRE(file.data.runs.size() == 2);
  const auto& run = file.data.runs[0];
  CHECK(run.id == "1");
  CHECK(run.heading == +1);
  CHECK(file.data.runs[1].heading == -1);
  CHECK(run.speed_m_s.at(0) == Approx(10.0));
  CHECK(run.conditions.ambient_K.at(0) == Approx(288.15));
  CHECK(run.conditions.ambient_pressure_Pa.at(2) == Approx(99e3));
  CHECK(file.data.runs[1].conditions.wind_m_s.at(1) == 1.0);
  CHECK_FALSE(run.start_s.has_value());  // two runs on clocks of their own
}

TEST_CASE("a trace without runs and headings is one run of unknown heading", "[fast]") {
  const CoastdownFile file = read_text("time_s,speed_km_h\n0,100\n1,99\n2,98\n3,97\n");
  REQUIRE(file.data.runs.size() == 1);
  CHECK(file.data.runs[0].heading == 0);
}

TEST_CASE("headings in degrees are sorted by the first", "[fast]") {
  const CoastdownFile file = read_text(
      "time_s,speed_km_h,run,heading\n0,100,a,350\n1,90,a,350\n0,100,b,171\n1,90,b,171\n0,100,c,12\n1,90,c,12\n");
  CHECK(file.data.runs.at(0).heading == +1);
  CHECK(file.data.runs.at(1).heading == -1);
  CHECK(file.data.runs.at(2).heading == +1);
}

TEST_CASE("bins: runs of several sessions, times of day, Off rows left out, other columns named", "[fast]") {
  const CoastdownFile file = read_text(
      "file,run,use,heading,start_time,v_hi_kmh,v_lo_kmh,dt_s,note\n"
      "x,1,On,+,13:29:42.5,90,81,5.5,ok\nx,1,On,+,13:29:42.5,81,72,6,ok\n"
      "y,1,On,-,13:31:00,90,81,5.5,ok\ny,2,Off,-,13:33:00,90,81,5.5,brake\n");
  CHECK_FALSE(file.is_trace);
  CHECK(file.rows_off == 1);
  REQUIRE(file.data.runs.size() == 2);
  CHECK(file.data.runs[0].bins.size() == 2);
  CHECK(file.data.runs[0].bins[0].high_m_s == Approx(25.0));
  CHECK(file.data.runs[0].bins[0].low_m_s == Approx(22.5));
  CHECK(*file.data.runs[0].start_s == Approx(13 * 3600 + 29 * 60 + 42.5));
  CHECK(file.data.runs[1].session == "y");
  CHECK(file.ignored_columns == std::vector<std::string>{"file", "note"});
}

TEST_CASE("bins without a run column: a run begins where the speed does not fall on", "[fast]") {
  const CoastdownFile file = read_text("v_hi_kmh,v_lo_kmh,dt_s\n90,80,5\n80,70,6\n90,80,5.5\n80,70,6.5\n");
  REQUIRE(file.data.runs.size() == 2);
  CHECK(file.data.runs[1].bins.size() == 2);
}

TEST_CASE("a run that turns is refused", "[fast]") {
  CHECK_THROWS_AS(read_text("time_s,speed_km_h,run,heading\n0,100,a,+\n1,90,a,-\n"), InputError);
}

TEST_CASE("a start time is a time of day, seconds or nothing", "[fast]") {
  const auto read = [](const std::string& start) {
    return read_text("start_time,v_hi_kmh,v_lo_kmh,dt_s\n" + start + ",90,80,5\n").data.runs[0].start_s;
  };
  CHECK(*read("13:29:42") == Approx(48582.0));
  CHECK(*read("48582.5") == Approx(48582.5));
  CHECK_FALSE(read("").has_value());
  for (const char* wrong : {"abc", "13:61:00", "13:29:60", "1:2:3:4", "13::29", "-5", "2026-01-16 13:29:42"}) {
    INFO(wrong);
    CHECK_THROWS_WITH(read(wrong), Catch::Contains("is not a time of day") && Catch::Contains("line 2"));
  }
}

TEST_CASE("bins: a column that is nearly a known one is refused, others are named", "[fast]") {
  const std::string rows = "\n90,80,5,1\n80,70,6,1\n";
  for (const auto& [name, meant] :
       {std::pair("ambient_C", "ambient_degC"), std::pair("wind_ms", "wind_m_s"), std::pair(" heading", "heading"),
        std::pair("ambient_pressure", "ambient_pressure_kPa"), std::pair("Slope_percent", "slope")}) {
    CHECK_THROWS_WITH(read_text(std::string("v_hi_kmh,v_lo_kmh,dt_s,") + name + rows),
                      Catch::Contains("is not read") && Catch::Contains(std::string("'") + meant + "'"));
  }
  const auto warnings = estimation::list_reading_warnings(read_text("v_hi_kmh,v_lo_kmh,dt_s,barometer" + rows));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("no such column: barometer"));
  CHECK(estimation::list_reading_warnings(read_text("v_hi_kmh,v_lo_kmh,dt_s,file" + rows)).empty());
}

TEST_CASE("headings that are a code and no degrees are refused", "[fast]") {
  const auto text = [](const std::string& one, const std::string& other) {
    return "time_s,speed_km_h,run,heading\n0,100,a," + one + "\n1,90,a," + one + "\n0,100,b," + other + "\n1,90,b," +
           other + "\n";
  };
  CHECK_THROWS_WITH(read_text(text("1", "2")),
                    Catch::Contains("1 and 2 look like a code") && Catch::Contains("line 4"));
  CHECK_THROWS_WITH(read_text(text("0", "1")), Catch::Contains("look like a code"));
  CHECK(read_text(text("1", "-1")).data.runs.at(1).heading == -1);
  CHECK(read_text(text("2", "182")).data.runs.at(1).heading == -1);
}

TEST_CASE("a mass or drag area that contradicts the manifest of the recording is doubted", "[fast]") {
  CoastdownFile file;
  CHECK(estimation::doubt_vehicle(file, 1500.0, 0.7).empty());
  file.vehicle = estimation::RecordedVehicle{1500.0, 45.0, 0.7};
  CHECK(estimation::doubt_vehicle(file, 1510.0, std::nullopt).empty());
  const auto doubts = estimation::doubt_vehicle(file, 1850.0, 7.0);
  REQUIRE(doubts.size() == 2);
  CHECK_THAT(doubts[0], Catch::Contains("1850 kg") && Catch::Contains("1500 kg"));
  CHECK_THAT(doubts[1], Catch::Contains("7 m2") && Catch::Contains("0.7 m2"));
}
