#pragma once
/// How well the numbers of a tire are known whose file does not say.

#include <map>
#include <string>

#include "models/ports.h"

namespace rollrig::estimation {

/// Standard uncertainties in SI units, by key as estimation/parameters.h has it. A number of a tire file is taken as a
/// draw from what tires of its class have, so that a class prior is a normal distribution around the file's number.
/// The uncertainties follow from mass and size of the tire and from the level of its loss, not from the number itself:
/// a number that was guessed too low is not known better for that.
/// Equation  s_C = 0.3 c m,  s_H = 0.3 h A,  s_f = 0.25 k_v A,  s_A1 = 0.3 A(v)/v_80,  s_B1 = 0.3 B(v)/v_80,
///           s_g = 0.15 * 2.5 p V/T,  s_x = q x_u,  s_G = q G_u A/A_u
/// Symbols   s standard uncertainty of the heat capacity C [J/K], of H [W/K], f [W s/(m K)], A1 [N s/m], B1
///           [s/(m K)]; m mass [kg] and A outer area [m2] of the tire; c = 1640 J/(kg K); h = 4.1 W/(m2 K);
///           k_v = 1.27 W s/(m3 K); s_g of the gas's heat capacity [J/K], p absolute reference pressure [Pa],
///           V 0.6 of the ring between rim and outer diameter [m3], T 298 K; s_x of a number of the tire's model
///           without a size of its own, s_G of a conductance [W/K] of it: q the share (usual_sd) and x_u, G_u the usual
///           value that the model declares (TireModelParameter), A_u = 0.93 m2; v `level_speed_m_s`, v_80 80 km/h [m/s]
/// Validity  tires of cars and trucks. All are independent
/// Source    Assumed: c, rubber of 1900 to 2000 J/(kg K) with a fifth of steel, of 460; 30 % of it, since compounds
///           differ by 10 %, masses typical of a size by 10 %, and the rim takes part in the heat: the calibrated tires
///           have 1940 to 2640 J/(kg K). h and k_v, those of the shipped tires and of the shipped drums; 30 % of both
///           is the spread of what is called typical, 25 % of k_v goes with a share at rest of 35 +- 15 % at 80 km/h.
///           A1, B1: the part of A and B that goes with speed differs by 30 % of both between tires. Gas: 15 %, by the
///           volume of the cavity, air at constant volume. Exponents: 0.06 of pressure (tests found 0.3 to 0.5), 0.1 of
///           load. speed_rise and speed_rise_of_fall of the model bounded: 0.3. A_u: area of a passenger car's tire,
///           225/55 R17
/// Checked   tests/estimation/class_priors_test.cpp, tests/estimation/fit_coverage_test.cpp
std::map<std::string, double> find_class_uncertainties(const models::TireParameters<double>& tire,
                                                       double level_speed_m_s);

/// Usual heat capacity of a tire of this mass: c m of the equation above.
double find_usual_heat_capacity_J_per_K(const models::TireParameters<double>& tire);

}  // namespace rollrig::estimation
