// The tire component of VECTO: written, checked against the schema, read again.
#include "exports/vecto_tire.h"

#include <boost/algorithm/string/replace.hpp>
#include <catch2/catch.hpp>

#include "sim/core/error.h"

using namespace rollrig;
using exports::VectoTire;

namespace {

/// The tire of VECTO's published example of a vehicle.
VectoTire make_example() {
  return {"WHL-5432198760-315-70-R22.5",
          "Generic Wheels Manufacturer",
          "Generic Wheel",
          "e12*0815/8051*2017/05E0000*00",
          "2017-01-11T14:00:00Z",
          "Tyre Generation App 1.0",
          "315/70 R22.5",
          0.0055,
          31300};
}

}  // namespace

TEST_CASE("a tire component has the elements of VECTO's example, in their order", "[fast]") {
  const std::string xml = exports::make_vecto_xml(make_example());
  // as in the example of schema 1.0, element by element
  const std::vector<std::string> elements{"<Manufacturer>Generic Wheels Manufacturer</Manufacturer>",
                                          "<Model>Generic Wheel</Model>",
                                          "<CertificationNumber>e12*0815/8051*2017/05E0000*00</CertificationNumber>",
                                          "<Date>2017-01-11T14:00:00Z</Date>",
                                          "<AppVersion>Tyre Generation App 1.0</AppVersion>",
                                          "<Dimension>315/70 R22.5</Dimension>",
                                          "<RRCDeclared>0.0055</RRCDeclared>",
                                          "<FzISO>31300</FzISO>"};
  std::size_t at = 0;
  for (const std::string& element : elements) {
    INFO(element);
    const std::size_t found = xml.find(element, at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
}

TEST_CASE("a tire component that is read again is the same", "[fast]") {
  VectoTire tire = make_example();
  tire.manufacturer =
      "R\xc3\xa4"
      "der & S\xc3\xb6hne <GmbH>";
  const VectoTire again = exports::read_vecto_xml(exports::make_vecto_xml(tire), "tire.xml");
  CHECK(again.id == tire.id);
  CHECK(again.manufacturer == tire.manufacturer);
  CHECK(again.model == tire.model);
  CHECK(again.certification_number == tire.certification_number);
  CHECK(again.date == tire.date);
  CHECK(again.app_version == tire.app_version);
  CHECK(again.dimension == tire.dimension);
  CHECK(again.rrc == Approx(tire.rrc));
  CHECK(again.load_N == tire.load_N);
}

TEST_CASE("the signature that VECTO's Hashing Tool adds is allowed", "[fast]") {
  std::string xml = exports::make_vecto_xml(make_example());
  boost::algorithm::replace_first(xml, "</Data>", "</Data><Signature/>");
  CHECK(exports::list_vecto_problems(xml).empty());
  boost::algorithm::replace_first(xml, "<Signature/>", "<Signature/><Signature/>");
  CHECK_FALSE(exports::list_vecto_problems(xml).empty());
}

TEST_CASE("the schema refuses each wrong element", "[fast]") {
  const std::string good = exports::make_vecto_xml(make_example());
  REQUIRE(exports::list_vecto_problems(good).empty());
  const std::vector<std::pair<const char*, const char*>> changes{
      {"0.0055", "0.00550"},                                             // five decimals
      {"0.0055", "5.5"},                                                 // N/kN
      {"0.0055", "-0.0055"},                                             // negative
      {"31300", "31300.5"},                                              // no whole number
      {"31300", "-1"},                                                   // negative
      {"315/70 R22.5</D", "315/70R22.5</D"},                             // size as others write it
      {"2017-01-11T14:00:00Z", "2016-01-11T14:00:00Z"},                  // before VECTO
      {"2017-01-11T14:00:00Z", "2017-01-11T14:00:00"},                   // no time zone
      {"Tyre Generation App 1.0", "1.0"},                                // too short
      {"<Model>Generic Wheel</Model>", ""},                              // missing
      {"<FzISO>31300</FzISO>", "<FzISO>31300</FzISO><FzISO>1</FzISO>"},  // twice
      {"id=\"WHL", "id=\"1WHL"},                                         // no name of XML
      {"id=\"WHL-5432198760-315-70-R22.5\"", ""},                        // missing
      {"DeclarationDefinitions:v1.0", "DeclarationDefinitions:v9.9"},    // another name space
      {"schemaVersion=\"1.0\"", "schemaVersion=\"-1.0\""},               // no version
      {"</tns:VectoInputDeclaration>", ""}};                             // torn
  for (const auto& [from, to] : changes) {
    INFO(from << " -> " << to);
    const std::string changed = boost::algorithm::replace_all_copy(good, from, to);
    REQUIRE(changed != good);
    CHECK_FALSE(exports::list_vecto_problems(changed).empty());
    CHECK_THROWS_AS(exports::read_vecto_xml(changed, "tire.xml"), InputError);
  }
}

TEST_CASE("what the schema or XML refuses is not written", "[fast]") {
  VectoTire tire = make_example();
  tire.dimension = "205/55 R16";
  CHECK_THROWS_AS(exports::make_vecto_xml(tire), InputError);
  tire = make_example();
  tire.manufacturer =
      "a\x01"
      "b";
  CHECK_THROWS_AS(exports::make_vecto_xml(tire), InputError);
  tire.manufacturer = "a\xff";
  CHECK_THROWS_AS(exports::make_vecto_xml(tire), InputError);
  tire.manufacturer = "";
  CHECK_THROWS_AS(exports::make_vecto_xml(tire), InputError);
}

TEST_CASE("a tire component reads no other file", "[fast]") {
  std::string xml = exports::make_vecto_xml(make_example());
  boost::algorithm::replace_first(xml, "<tns:", "<!DOCTYPE x [<!ENTITY e SYSTEM \"file:///etc/hostname\">]><tns:");
  boost::algorithm::replace_first(xml, "Generic Wheel<", "&e;<");
  CHECK_FALSE(exports::list_vecto_problems(xml).empty());
}
