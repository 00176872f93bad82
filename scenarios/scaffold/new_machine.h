#pragma once
/// Files of a user's own rig and vehicle.

#include <string>

#include "include/rollrig/scaffold_options.h"

namespace rollrig::scenarios {

/// Refuses a name that cannot stand in a TOML string as it is, or in the name of a file.
/// Errors    InputError: a quote, a slash, a backslash or a control character
/// Checked   tests/scenarios/scaffold_test.cpp
void require_plain_name(const std::string& name);

/// The TOML of a rig: that of the asset of its kind, with the given numbers. An inertia that is not given follows from
/// the diameter.
/// Equation  J = J_a (D/D_a)^3
/// Symbols   J moment of inertia, D diameter, a: of the asset
/// Source    Assumed: a shell of the same thickness and width
/// Errors    InputError: an unknown kind, a number that cannot be, or that rigs of this kind do not have
/// Checked   tests/scenarios/scaffold_test.cpp
std::string write_new_rig(const NewRigOptions& options);

/// The TOML of a vehicle with four wheels. A drag area that is not given follows from C of the road load.
/// Equation  A_d = 2 C / rho, rho = 1.167 kg/m3
/// Symbols   A_d drag area; C of A + B v + C v^2; rho density of the air at 20 degC and 98.21 kPa
/// Source    40 CFR 1066.305 for the air; Assumed: all of C is drag, as in volvo_ex30
/// Errors    InputError: neither drag area nor road load, or a number that cannot be
/// Checked   tests/scenarios/scaffold_test.cpp
std::string write_new_vehicle(const NewVehicleOptions& options);

}  // namespace rollrig::scenarios
