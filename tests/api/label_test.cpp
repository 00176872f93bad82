// Label classes and the tire of VECTO by a program of somebody else's, through the shared library.
#include <rollrig/error.h>
#include <rollrig/label.h>
#include <rollrig/vecto.h>

#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using rollrig::LabelInput;
using rollrig::make_label;
using rollrig::TireLabel;
using rollrig::tests::run_program;

namespace {

/// The option that is named where the input is refused.
std::string find_refused_label(const LabelInput& input) {
  try {
    make_label(input);
  } catch (const rollrig::InputError& error) {
    return error.problem().key;
  }
  return "";
}

LabelInput make_label_input(double rrc_N_per_kN, const char* tire_class) {
  LabelInput input;
  input.rrc_N_per_kN = rrc_N_per_kN;
  input.tire_class = tire_class;
  return input;
}

rollrig::VectoTireInput make_vecto_input(const char* tire) {
  rollrig::VectoTireInput input;
  input.tire = tire;
  return input;
}

}  // namespace

TEST_CASE("a label is found as the command finds it", "[fast]") {
  LabelInput input = make_label_input(8.4, "C1");
  const TireLabel label = make_label(input);
  CHECK(label.text == run_program("label --rrc 8.4 --class C1").out);
  CHECK(label.json == run_program("label --rrc 8.4 --class C1 --json -").out);
  CHECK(label.label_class == "C");
  CHECK(label.limits[1].is_met);
  CHECK(label.json.find("\"declared_rrc_N_per_kN\": 8.4,") != std::string::npos);  // not 8.4000000000000004
  input.rrc_sd_N_per_kN = 0.5;
  input.is_severe_snow = true;
  input.load_index = "91";
  input.speed_symbol = "v";
  const std::string command = "label --rrc 8.4 --class C1 --rrc-sd 0.5 --severe-snow --load-index 91 --speed-symbol v";
  CHECK(make_label(input).json == run_program(command + " --json -").out);
}

TEST_CASE("a load index from 122 tells class C3 by itself, and a tire file its own", "[fast]") {
  LabelInput input = make_label_input(5.55, "");
  input.load_index = "156/150";
  CHECK(make_label(input).tire_class == "C3");
  LabelInput of_tire;
  of_tire.tire = "c3_315_80r22_5";
  const TireLabel label = make_label(of_tire);
  CHECK(label.label_class == "C");
  CHECK(label.rrc_N_per_kN == Approx(5.55).epsilon(0.01));
  CHECK(label.warnings.empty());
}

TEST_CASE("the rolling resistance that the terms of a label cannot be found for is refused", "[fast]") {
  CHECK(find_refused_label(make_label_input(8.4, "C1")).empty());
  CHECK(find_refused_label(make_label_input(80.0, "C1")) == "--rrc");
  CHECK(find_refused_label(make_label_input(0.008, "C1")) == "--rrc");
  CHECK(find_refused_label(make_label_input(8.4, "C4")) == "--class");
  CHECK(find_refused_label(make_label_input(8.4, "")) == "--class");
  CHECK(find_refused_label({}) == "--class");
  LabelInput input = make_label_input(8.4, "C2");
  input.load_index = "150";
  CHECK(find_refused_label(input) == "--class");
  input.load_index = "59";
  CHECK(find_refused_label(input) == "--load-index");
  input.load_index = "109";
  input.speed_symbol = "I";
  CHECK(find_refused_label(input) == "--speed-symbol");
  input.speed_symbol = "L";
  CHECK(find_refused_label(input) == "--class");
  input.speed_symbol = "T";
  CHECK(find_refused_label(input).empty());
  input.rrc_sd_N_per_kN = -1.0;
  CHECK(find_refused_label(input) == "--rrc-sd");
  LabelInput of_tire;
  of_tire.tire = "a50";  // without [service_description]
  CHECK(find_refused_label(of_tire) == "--class");
}

TEST_CASE("class C3 with a load index below 122 is doubted where no speed symbol tells", "[fast]") {
  LabelInput input = make_label_input(5.0, "C3");
  CHECK(make_label(input).warnings.empty());
  input.load_index = "91";
  const TireLabel label = make_label(input);
  REQUIRE(label.warnings.size() == 1);
  CHECK(label.warnings[0].find("unless its speed symbol is M or a lower one") != std::string::npos);
  input.load_index = "118/116";
  input.speed_symbol = "M";
  CHECK(make_label(input).warnings.empty());
  input.speed_symbol = "R";
  CHECK(find_refused_label(input) == "--class");
  input = make_label_input(8.4, "C1");
  input.load_index = "125";
  CHECK(make_label(input).warnings.size() == 1);
}

TEST_CASE("a speed symbol may stand behind the load index, as on the sidewall", "[fast]") {
  LabelInput input = make_label_input(5.0, "C3");
  input.load_index = "118/116 R";  // class C3 needs a symbol up to M with it
  CHECK(find_refused_label(input) == "--class");
  input.load_index = "118/116m";
  CHECK(make_label(input).warnings.empty());
  input.speed_symbol = "M";
  CHECK(make_label(input).warnings.empty());
  input.speed_symbol = "L";
  CHECK(find_refused_label(input) == "--speed-symbol");
  input = make_label_input(8.4, "C1");
  input.load_index = "109/107T";
  REQUIRE(make_label(input).warnings.size() == 1);
  CHECK(make_label(input).warnings[0].find("is the class C2 or C3") != std::string::npos);
  input.load_index = "91O";
  CHECK(find_refused_label(input) == "--load-index");
}

TEST_CASE("a load index or speed symbol that is not the one of the tire's file is refused", "[fast]") {
  LabelInput input;
  input.tire = "c1_205_55r16";
  input.rrc_N_per_kN = 8.4;
  input.load_index = "92";
  CHECK(find_refused_label(input) == "--load-index");
  input.load_index = "91";
  input.speed_symbol = "v";
  CHECK(find_refused_label(input).empty());
  input.speed_symbol = "H";
  CHECK(find_refused_label(input) == "--speed-symbol");
  input.tire = "a50";  // without [service_description]
  input.tire_class = "C1";
  CHECK(find_refused_label(input).empty());
}

TEST_CASE("an RRc far above the limit of its class asks whether the class is right", "[fast]") {
  CHECK(make_label(make_label_input(11.9, "C3")).warnings.empty());
  const TireLabel label = make_label(make_label_input(20.0, "C3"));
  REQUIRE(label.warnings.size() == 1);
  CHECK(label.warnings[0].find("stage 1, 8 N/kN: is the class C3 right?") != std::string::npos);
  CHECK(label.text.find("an RRc of 20 N/kN") != std::string::npos);
  CHECK(label.json.find("is the class C3 right?") != std::string::npos);
  rollrig::VectoTireInput input = make_vecto_input("c3_315_80r22_5");
  CHECK(rollrig::make_vecto_tire(input).warnings.empty());
  input.rrc_N_per_kN = 25.0;
  const rollrig::VectoTireFile made = rollrig::make_vecto_tire(input);
  REQUIRE(made.warnings.size() == 1);
  CHECK(made.warnings[0].find("an RRc of 25 N/kN") != std::string::npos);
}

TEST_CASE("an RRc far below class A asks whether the class is right", "[fast]") {
  for (const double low : {2.0, 3.8}) CHECK(make_label(make_label_input(low, "C1")).warnings.size() == 1);
  CHECK(make_label(make_label_input(4.0, "C1")).warnings.empty());
  CHECK(make_label(make_label_input(3.9, "C1")).warnings.empty());   // 0.6 times 6.5, which is reached
  CHECK(make_label(make_label_input(18.0, "C1")).warnings.empty());  // 1.5 times 12
  CHECK(make_label(make_label_input(2.5, "C3")).warnings.empty());
  rollrig::VectoTireInput input = make_vecto_input("c3_315_80r22_5");
  input.rrc_N_per_kN = 2.0;
  CHECK(rollrig::make_vecto_tire(input).warnings.size() == 1);
}

TEST_CASE("a tire has no label and no tire of VECTO where its test has no class", "[fast]") {
  const rollrig::tests::TemporaryFolder folder;
  const auto change = [&folder](const std::string& tire, const std::string& from, const std::string& to) {
    std::string text = rollrig::tests::read_file(ROLLRIG_SOURCE_DIR "/assets/tires/" + tire + ".toml");
    const std::size_t place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
    const std::string path = folder.file("tire.toml");
    rollrig::tests::write_file(path, text);
    return path;
  };
  const auto is_refused = [](const std::string& path) {
    LabelInput input;
    input.tire = path;
    CHECK_THROWS_AS(make_label(input), rollrig::InputError);
    input.rrc_N_per_kN = 8.0;  // of the standard's test
    CHECK(make_label(input).warnings.size() == 1);
  };
  is_refused(change("c1_205_55r16", "\nload_N = 4825.0", "\nload_N = 3000.0"));
  is_refused(change("c1_205_55r16", "\npressure_kPa = 210.0", "\npressure_kPa = 300.0"));
  is_refused(change("c2_215_65r16c", "\nwarm_up_min = 50.0", "\nwarm_up_min = 10.0"));
  const std::string truck = change("c3_315_80r22_5", "\nload_N = 33350.0", "\nload_N = 20000.0");
  CHECK_THROWS_AS(rollrig::make_vecto_tire(make_vecto_input(truck.c_str())), rollrig::InputError);
}

TEST_CASE("a label and a tire of VECTO have the warnings of the test that they simulate", "[fast]") {
  const rollrig::tests::TemporaryFolder folder;
  const auto make_slow = [&folder](const std::string& tire) {
    std::string text = rollrig::tests::read_file(ROLLRIG_SOURCE_DIR "/assets/tires/" + tire + ".toml");
    const std::string key = "\nheat_capacity_J_per_K = ";
    text.replace(text.find(key), key.size(), key + "5");  // 15250 becomes 515250
    const std::string path = folder.file("tire.toml");
    rollrig::tests::write_file(path, text);
    return path;
  };
  const auto is_unsettled = [](const std::vector<std::string>& warnings) {
    return warnings.size() == 1 && warnings[0].find("above that in steady state") != std::string::npos;
  };
  LabelInput input;
  input.tire = make_slow("c1_205_55r16");
  CHECK(is_unsettled(make_label(input).warnings));
  const std::string truck = make_slow("c3_315_80r22_5");
  CHECK(is_unsettled(rollrig::make_vecto_tire(make_vecto_input(truck.c_str())).warnings));
}

TEST_CASE("a tire without marks has a label by its class alone", "[fast]") {
  LabelInput input;
  input.tire = "a50";
  input.tire_class = "C1";
  CHECK(make_label(input).warnings.empty());
}

TEST_CASE("a size for VECTO that is not that of the tire is doubted", "[fast]") {
  rollrig::VectoTireInput input = make_vecto_input("c2_215_65r16c");
  CHECK(rollrig::make_vecto_tire(input).warnings.empty());
  input.dimension = "215/65R16C";  // spaces do not count
  CHECK(rollrig::make_vecto_tire(input).warnings.empty());
  input.dimension = "315/80 R22.5";
  CHECK(rollrig::make_vecto_tire(input).warnings.size() == 1);
}

TEST_CASE("a text for VECTO that is given is not empty", "[fast]") {
  const auto find_refused_text = [](std::optional<std::string> rollrig::VectoTireInput::*text, const char* given) {
    rollrig::VectoTireInput input = make_vecto_input("c3_315_80r22_5");
    input.rrc_N_per_kN = 5.5;
    input.*text = given;
    try {
      rollrig::make_vecto_tire(input);
    } catch (const rollrig::InputError& error) {
      return error.problem().key;
    }
    return std::string();
  };
  using Input = rollrig::VectoTireInput;
  CHECK(find_refused_text(&Input::manufacturer, "") == "--manufacturer");
  CHECK(find_refused_text(&Input::manufacturer, " \t") == "--manufacturer");
  CHECK(find_refused_text(&Input::model, "") == "--model");
  CHECK(find_refused_text(&Input::certification_number, "") == "--certification-number");
  CHECK(find_refused_text(&Input::date, "") == "--date");
  CHECK(find_refused_text(&Input::dimension, "") == "--dimension");
  CHECK(find_refused_text(&Input::model, "X").empty());
}

TEST_CASE("the tire of VECTO is that of the command, with RRc and load of the test", "[fast]") {
  const rollrig::VectoTireFile made = rollrig::make_vecto_tire(make_vecto_input("c3_315_80r22_5"));
  CHECK(made.xml == run_program("export c3_315_80r22_5 --vecto -").out);
  CHECK(made.load_N == 33350);
  CHECK(made.rrc == Approx(0.0055).margin(1.01e-4));  // 5.55 N/kN, rounded to one side or the other
  CHECK(made.xml.find("<FzISO>33350</FzISO>") != std::string::npos);
  rollrig::VectoTireInput input = make_vecto_input("c3_315_80r22_5");
  input.rrc_N_per_kN = 4.87;
  input.dimension = "315/70 R22.5";
  const rollrig::VectoTireFile declared = rollrig::make_vecto_tire(input);
  CHECK(declared.rrc == Approx(0.0049));
  input.dimension = "315/70R22.5";  // spaces do not count
  CHECK(rollrig::make_vecto_tire(input).xml == declared.xml);
  CHECK(declared.xml.find("<RRCDeclared>0.0049</RRCDeclared>") != std::string::npos);
  input.rrc_N_per_kN = 49.0;
  CHECK_THROWS_AS(rollrig::make_vecto_tire(input), rollrig::InputError);
  CHECK_THROWS_AS(rollrig::make_vecto_tire(make_vecto_input("c1_205_55r16")),
                  rollrig::InputError);  // VECTO has no such size
}
