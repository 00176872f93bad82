#pragma once
/// The tire component of VECTO, the EU's simulator of heavy vehicles, as XML.

#include <string>
#include <vector>

namespace rollrig::exports {

/// The data of one tire, as VECTO's schema has them. P046 and the like are the parameters' identifiers there.
struct VectoTire {
  std::string id;                    // of the Data element: a letter, then letters, digits, '-', '_', '.'
  std::string manufacturer;          // P230
  std::string model;                 // P231
  std::string certification_number;  // P267
  std::string date;                  // P233: 2017-01-01T00:00:00Z or later, in UTC
  std::string app_version;           // P234, five characters at least
  std::string dimension;             // P108: one of list_vecto_dimensions()
  double rrc = 0.0;                  // P046: RRCDeclared [N/N], written with four decimals
  int load_N = 0;                    // P047: FzISO
};

/// Sizes that VECTO's schema allows, as it writes them: "315/80 R22.5".
const std::vector<std::string>& list_vecto_dimensions();

/// The XML of the component, without Signature: VECTO's Hashing Tool takes such a file, sets the date, and adds the
/// signature that VECTO's schema asks for. It is checked against the schema before it is returned.
/// Source    VectoComponent.1.0.xsd and VectoDeclarationDefinitions.1.0.xsd of VECTO (urn:tugraz:ivt:VectoAPI:
///           DeclarationComponent:v1.0 and DeclarationDefinitions:v1.0): elements, their order, types and restrictions.
///           The schema here states these of the tire in its own words, with Signature optional. Assumed: manufacturer
///           and model are not empty; their types were not read
/// Errors    InputError: text that is no UTF-8 or has control characters; what the schema refuses
/// Checked   tests/exports/vecto_tire_test.cpp
std::string make_vecto_xml(const VectoTire& tire);

/// What the schema says against a document; empty where it is valid. A Signature may be there.
std::vector<std::string> list_vecto_problems(const std::string& xml);

/// Reads a component that make_vecto_xml() or VECTO's Hashing Tool wrote. Throws InputError where the schema refuses
/// it.
VectoTire read_vecto_xml(const std::string& xml, const std::string& path);

}  // namespace rollrig::exports
