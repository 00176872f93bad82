#pragma once
/// A tire for VECTO, the EU's simulator of heavy vehicles. What is in the file, and its sources: docs/label.md.

#include <optional>
#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

/// The tire, and what a tire file does not say. Errors name a member as the option of the command line:
/// certification_number as "--certification-number".
struct VectoTireInput {
  std::string tire;                                 // name of an asset, or a path
  std::optional<double> rrc_N_per_kN;               // to declare; absent: by the simulated test of ISO 28580
  std::optional<std::string> manufacturer;          // absent: "simulated"
  std::optional<std::string> model;                 // absent: the name of the tire
  std::optional<std::string> certification_number;  // absent: "simulated, not certified"
  std::optional<std::string> date;       // in UTC; absent: 2017-01-01T00:00:00Z, which VECTO's Hashing Tool replaces
  std::optional<std::string> dimension;  // as VECTO writes it; absent: the designation of the tire
};

/// The component as XML, checked against the schema.
struct VectoTireFile {
  std::string xml;
  double rrc = 0.0;  // RRCDeclared [N/N]: rounded to 0.1 N/kN
  int load_N = 0;    // FzISO
  std::vector<std::string> warnings;
};

/// Makes the tire component of VECTO, schema 1.0, without signature.
/// Example  input.tire = "c3_315_80r22_5"; write_folder("vecto", {{"tire.xml", make_vecto_tire(input).xml}});
/// Errors   InputError: an unknown tire, or one without [iso_28580]; an RRc that no tire has; a size that VECTO does not
///          know; a text that is empty; a text or a date that its schema refuses
VectoTireFile make_vecto_tire(const VectoTireInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
