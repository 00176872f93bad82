// The file of an FMU: what is in it, and that its shared object needs nothing but the C library.
#include <libxml/xmlschemas.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "build_paths.h"
#include "rollrig/error.h"
#include "rollrig/fmu.h"
#include "tests/fmu/importer.h"
#include "tests/support/run_program.h"

using namespace rollrig::tests;

namespace {

/// Whether XML is as one of the schemas of the standard has it.
bool is_valid(const std::string& xml, const std::string& schema_path) {
  xmlSchemaParserCtxt* parser = xmlSchemaNewParserCtxt(schema_path.c_str());
  xmlSchema* schema = xmlSchemaParse(parser);
  REQUIRE(schema != nullptr);
  xmlDoc* doc = xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "modelDescription.xml", nullptr, 0);
  xmlSchemaValidCtxt* context = xmlSchemaNewValidCtxt(schema);
  const bool valid = xmlSchemaValidateDoc(context, doc) == 0;
  xmlSchemaFreeValidCtxt(context);
  xmlFreeDoc(doc);
  xmlSchemaFree(schema);
  xmlSchemaFreeParserCtxt(parser);
  return valid;
}

std::string find_own_schema(int version) {
  return std::string(ROLLRIG_SOURCE_DIR) + "/tests/fmu/fmi" + std::to_string(version) + "_description.xsd";
}

std::string read_model_name(const std::string& xml) {
  xmlDoc* doc = xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "modelDescription.xml", nullptr, 0);
  REQUIRE(doc != nullptr);
  xmlChar* name = xmlGetProp(xmlDocGetRootElement(doc), reinterpret_cast<const xmlChar*>("modelName"));
  REQUIRE(name != nullptr);
  const std::string found(reinterpret_cast<const char*>(name));
  xmlFree(name);
  xmlFreeDoc(doc);
  return found;
}

}  // namespace

TEST_CASE("rollrig export fmu writes an FMU of a tire, the same bytes each time", "[fast]") {
  const TemporaryFolder folder;
  for (const char* file : {"tire.fmu", "again.fmu"}) {
    const ProgramResult made = run_program(std::string("export fmu --tire a50 --out ") + file, folder.path());
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(made.out == std::string("written to ") + file + "\n");
  }
  const std::string bytes = read_file(folder.file("tire.fmu"));
  CHECK(bytes == read_file(folder.file("again.fmu")));
  const auto files = read_zip(bytes);
  CHECK(files.at("resources/tire.toml") == read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml"));
  const Description description = read_description(files.at("modelDescription.xml"));
  CHECK(description.fmi_version == "2.0");
  CHECK(description.list("input").size() == 6);
  CHECK(description.variables.at("thermal.gas_heat_capacity_J_per_K").causality == "parameter");
  CHECK(description.variables.at("cavity_pressure_Pa").unit == "Pa");
  CHECK(files.count("binaries/linux64/" + description.identifier + ".so") == 1);
}

TEST_CASE("every tire that is shipped becomes an FMU that starts as its description says", "[fast]") {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires")) {
    INFO(entry.path());
    const LoadedFmu fmu(entry.path().stem().string(), "drum_2m");
    Fmi2 tire(fmu, fmi2CoSimulation);
    for (const auto& [name, variable] : fmu.description().variables) {
      INFO(name);
      if (variable.has_start) CHECK(tire.get(name) == variable.start);
      CHECK(variable.has_start == (variable.causality == "input" || variable.causality == "parameter"));
    }
    tire.initialize();
    tire.set("speed_m_s", 20.0);
    tire.step(0.0, 600.0);
    CHECK(tire.get("liner_temperature_K") > tire.get("ambient_temperature_K") + 5.0);
  }
}

TEST_CASE("the shared object of an FMU needs the C library alone and shows the interface alone", "[fast]") {
#ifdef ROLLRIG_SANITIZED
  return;  // sanitizers bring libraries of their own
#endif
  const LoadedFmu fmu("a50");
  const ProgramResult needs = run_other("/usr/bin/readelf", "--dynamic --wide '" + fmu.library() + "'");
  REQUIRE(needs.status == 0);
  std::size_t libraries = 0;
  for (std::size_t at = needs.out.find("(NEEDED)"); at != std::string::npos; at = needs.out.find("(NEEDED)", at + 1)) {
    const std::string line = needs.out.substr(at, needs.out.find('\n', at) - at);
    INFO(line);
    CHECK((line.find("[libc.so") != std::string::npos || line.find("[libm.so") != std::string::npos ||
           line.find("[ld-linux") != std::string::npos));
    ++libraries;
  }
  CHECK(libraries >= 1);
  const ProgramResult shows = run_other("/usr/bin/nm", "--dynamic --defined-only '" + fmu.library() + "'");
  REQUIRE(shows.status == 0);
  std::istringstream lines(shows.out);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK((line.find(" fmi2") != std::string::npos || line.find(" fmi3") != std::string::npos));
  }
}

TEST_CASE("the description is as the schemas of the standard have it", "[fast]") {
  // tests/fmu has what the standard says of the parts that are written, in our words. The standard's own schemas are
  // not part of rollrig: ROLLRIG_FMI_SCHEMAS is a folder that has them, in its folders 2 and 3.
  const char* schemas = std::getenv("ROLLRIG_FMI_SCHEMAS");
  for (const int version : {2, 3}) {
    const auto files = read_zip(rollrig::make_fmu({"a50", "drum_2m", {"slip_loss", "bearing_warmup"}, version}));
    const std::string& xml = files.at("modelDescription.xml");
    const Description description = read_description(xml);
    CHECK(description.fmi_version == (version == 2 ? "2.0" : "3.0"));
    CHECK(description.variables.size() > 50);
    const std::string name = std::to_string(version);
    const std::string own = find_own_schema(version);
    CHECK(is_valid(xml, own));
    CHECK_FALSE(is_valid(std::string(xml).replace(xml.find("causality"), 9, "casuality"), own));
    if (schemas == nullptr) continue;
    CHECK(is_valid(xml, std::string(schemas) + "/" + name + "/fmi" + name + "ModelDescription.xsd"));
  }
}

TEST_CASE("the description holds any name of a tire or a rig, or the name is refused with its file", "[fast]") {
  const TemporaryFolder folder;
  const auto write_named = [&](const std::string& kind, const std::string& from, const std::string& name) {
    std::string text = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/" + kind + "/" + from + ".toml");
    const std::size_t at = text.find("\nname = ") + 1;
    text.replace(at, text.find('\n', at) - at, "name = " + name);
    write_file(folder.file(kind + ".toml"), text);
    return folder.file(kind + ".toml");
  };
  for (const auto& [written, name] : {std::pair(R"("<b a='1'>\"&amp; & ]]>")", R"(<b a='1'>"&amp; & ]]>)"),
                                      std::pair("\"Winterreifen f\u00fcr Schnee\"", "Winterreifen f\u00fcr Schnee")}) {
    for (const int version : {2, 3}) {
      const std::string xml =
          read_zip(rollrig::make_fmu(
                       {write_named("tires", "a50", written), write_named("rigs", "drum_2m", written), {}, version}))
              .at("modelDescription.xml");
      CHECK(is_valid(xml, find_own_schema(version)));
      CHECK(read_model_name(xml) == name);
    }
  }
  for (const char* bad : {R"("a\u0001b")", R"("a\nb")", R"("a\tb")", R"("a\u007Fb")", R"("a\uFFFFb")"}) {
    INFO(bad);
    const std::string good_tire = write_named("tires", "a50", "\"good\"");
    const std::string bad_rig = write_named("rigs", "drum_2m", bad);
    CHECK_THROWS_WITH(rollrig::make_fmu({good_tire, bad_rig, {}}),
                      Catch::Contains("the name of the rig") && Catch::Contains("rigs.toml"));
    const std::string bad_tire = write_named("tires", "a50", bad);
    CHECK_THROWS_WITH(rollrig::make_fmu({bad_tire, "road", {}}),
                      Catch::Contains("the name of the tire") && Catch::Contains("tires.toml"));
  }
}

TEST_CASE("what no FMU can be made of is refused", "[fast]") {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& arguments, const std::string& words) {
    const ProgramResult told = run_program("export fmu " + arguments + " --out tire.fmu", folder.path());
    INFO(arguments << "\n" << told.err);
    CHECK(told.status == 2);
    CHECK_THAT(flatten(told.err), Catch::Contains(words));
    CHECK(folder.entry_count() == 0);
  };
  refuse("--tire a5", "a50");
  refuse("--tire a50 --rig drum", "drum_2m");
  refuse("--tire a50 --fmi 1", "2 or 3");
  refuse("--tire a50 --fmi 1", "--fmi");
  refuse("--tire a50 --effects slip", "slip_loss");
  refuse("--tire a50 --effects slip_loss,bearing_warmup",
         "--effects value bearing_warmup");                                     // the road has no bearings
  refuse("--tire a50 --rig drum_2m --effects torque_gain", "changes nothing");  // of a sensor
  CHECK(run_program("export", folder.path()).status == 2);
  try {
    rollrig::make_fmu({"a50", "road", {}, 1});
    FAIL("FMI 1 was not refused");
  } catch (const rollrig::InputError& error) {
    CHECK(error.problem().key == "fmi_version");
    CHECK(error.problem().file.empty());
  }
}
