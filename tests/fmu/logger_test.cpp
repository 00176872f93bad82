// What an importer is told, and how it switches that on and off.
#include <catch2/catch.hpp>

#include "rollrig/fmu.h"
#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::Fmi3;
using rollrig::tests::LoadedFmu;

namespace {

/// Whether modelDescription.xml declares a category.
bool is_declared(int fmi_version, const std::string& category) {
  const auto files = rollrig::tests::read_zip(rollrig::make_fmu({"a50", "road", {}, fmi_version}));
  const std::string& xml = files.at("modelDescription.xml");
  const std::size_t from = xml.find("<LogCategories>");
  const std::size_t at = xml.find("<Category name=\"" + category + "\"", from);
  return at < xml.find("</LogCategories>", from);
}

}  // namespace

TEST_CASE("the importer of version 2 switches messages on and off by category", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation, "tire", false);
  const auto step_too_early = [&] { return FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 1.0, fmi2True); };
  const auto set_logging = [&](bool on, std::vector<const char*> categories) {
    return FMI2(fmu, fmi2SetDebugLogging)(tire.component, on ? fmi2True : fmi2False, categories.size(),
                                          categories.data());
  };
  CHECK(step_too_early() == fmi2Error);
  CHECK(tire.messages.empty());
  REQUIRE(set_logging(true, {}) == fmi2OK);
  CHECK(step_too_early() == fmi2Error);
  REQUIRE(tire.told.size() == 1);
  CHECK(tire.told[0].status == fmi2Error);
  CHECK(is_declared(2, tire.told[0].category));

  tire.initialize();
  fmi2Integer value = 0;
  const auto ask = [&] { return FMI2(fmu, fmi2GetIntegerStatus)(tire.component, fmi2DoStepStatus, &value); };
  CHECK(ask() == fmi2Discard);
  REQUIRE(tire.told.size() == 2);
  CHECK(tire.told[1].status == fmi2Discard);
  CHECK(tire.told[1].category != tire.told[0].category);
  CHECK(is_declared(2, tire.told[1].category));
  REQUIRE(set_logging(false, {tire.told[0].category.c_str()}) == fmi2OK);
  CHECK(ask() == fmi2Discard);
  CHECK(tire.told.size() == 3);
  CHECK(FMI2(fmu, fmi2DoStep)(tire.component, 7.0, 1.0, fmi2True) == fmi2Error);
  CHECK(tire.told.size() == 3);
  REQUIRE(set_logging(false, {}) == fmi2OK);
  CHECK(ask() == fmi2Discard);
  CHECK(tire.told.size() == 3);

  // What is not declared changes nothing.
  REQUIRE(set_logging(true, {}) == fmi2OK);
  CHECK(set_logging(false, {tire.told[0].category.c_str(), "logEvents"}) == fmi2Error);
  CHECK_THAT(tire.messages.back(), Catch::Contains("logEvents"));
  CHECK(FMI2(fmu, fmi2SetDebugLogging)(tire.component, fmi2False, 1, nullptr) == fmi2Error);
  CHECK(tire.told.size() == 5);
}

TEST_CASE("the importer of version 3 switches messages on and off", "[fast]") {
  const LoadedFmu fmu("a50", "road", 3);
  Fmi3 tire(fmu, true, false);
  CHECK(tire.step(0.0, 1.0) == fmi3Error);
  CHECK(tire.messages.empty());
  const char* category = "logStatusError";
  REQUIRE(is_declared(3, category));
  REQUIRE(FMI3(fmu, fmi3SetDebugLogging)(tire.instance, true, 1, &category) == fmi3OK);
  CHECK(tire.step(0.0, 1.0) == fmi3Error);
  REQUIRE(tire.told.size() == 1);
  CHECK(tire.told[0].status == fmi3Error);
  CHECK(tire.told[0].category == category);
  const char* other = "logStatusDiscard";
  CHECK_FALSE(is_declared(3, other));
  CHECK(FMI3(fmu, fmi3SetDebugLogging)(tire.instance, false, 1, &other) == fmi3Error);
  CHECK(tire.told.size() == 2);
  REQUIRE(FMI3(fmu, fmi3SetDebugLogging)(tire.instance, false, 0, nullptr) == fmi3OK);
  CHECK(tire.step(0.0, 1.0) == fmi3Error);
  CHECK(tire.told.size() == 2);
}
