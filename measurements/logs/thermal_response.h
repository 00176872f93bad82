#pragma once
/// What a tire's temperatures may do when speed and load change.

#include "measurements/logs/log.h"
#include "measurements/logs/tie.h"

namespace rollrig::measurements {

enum class Response { kRubber, kGas };

/// Functions whose sums stand for the response of a temperature to the speed and load of a torque log: no
/// model of a tire but what all have, that heat is stored and so temperature bends, but does not jump, when its source
/// does.
///
/// Equation  rubber: L_tau[u](t) = integral of u(s) exp(-(t-s)/tau)/tau ds, tau in {200, 600, 2000} s,
///           u in {F v, F v^2, v, F v T', v T'}, T' = L_600[F v]: the last two for a loss that falls and a cooling that
///           rises with temperature; gas, a second store: (tau L_tau[u] - sigma L_sigma[u])/(tau - sigma), which
///           starts without a bend, sigma in {10, 30, 90} s
/// Symbols   F load, v speed, both of the torque log, linear between rows; load jumps half-way between rows, or at the
///           later row with `at_rows`. Without load (road) F = 1
/// Validity  the time constants bracket those of car tires (heat capacity over z + f v: 300 to 1200 s). Assumed
/// Checked   tests/measurements/logs/clock_test.cpp
Basis make_response_basis(const Log& torque_log, Response response, bool at_rows);

/// Decays of what came before the torque log begins: the constants above.
std::vector<double> response_decays_s(Response response);

}  // namespace rollrig::measurements
