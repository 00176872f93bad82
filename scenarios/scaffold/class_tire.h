#pragma once
/// A complete tire from its size, load index and RRc, with the values of its class.

#include <map>
#include <string>
#include <vector>

#include "include/rollrig/scaffold_options.h"
#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

struct ClassTire {
  models::TireFile tire;
  std::map<std::string, std::string> notes;  // source of each number, for write_tire
  std::string tire_class;                    // "C1"
  std::string class_reason;
  std::string base;                    // name of the asset that gives the values of the class
  models::ServiceDescription service;  // in the tire too, where the file can say it
  double load_capacity_N = 0.0;
  std::vector<std::string> warnings = {};  // of the tire property file and of the class
};

/// Values of the reference tires of the assets, in proportion to size and load where that is usual; bounded.loss_N is
/// scaled to the RRc.
/// Source    Loads and pressures of ISO 28580: 80 % of the load of the index and 210 kPa (reinforced 250 kPa) of class
///           C1, §3.2.3.1 of Kolekar and Narasimhan (2024); 85 % and the pressure of the maximum load of C2 and C3,
///           Assumed: the standard was not read. Fall with temperature: K_t of UN Regulation No. 117, Annex 6, 6.2.
///           Else see the notes
/// RRc       without options.rrc_N_per_kN: that of the tire property file at 80 km/h and the load and pressure of the
///           test, carried from its flat surface to the 2 m drum by (3.1). Assumed: it is of a warm tire in air of
///           25 degC, and its pressures are gauge, since the file says neither
/// Errors    InputError: a size, load index, class or number that cannot be; no pressure of class C2 or C3; not one of
///           RRc and property file; a file without rolling resistance
/// Checked   tests/scenarios/scaffold_test.cpp
ClassTire make_class_tire(const NewTireOptions& options);

/// The file as TOML, with its notes.
std::string write_class_tire(const ClassTire& made);

/// The comments of a TOML text by the dotted key of their lines: "bounded.loss_N".
std::map<std::string, std::string> read_comments(const std::string& toml);

}  // namespace rollrig::scenarios
