#pragma once
/// The rolling resistance of a tire property file (.tir) of the Magic Formula.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rollrig::tables {

/// What a .tir file says of rolling resistance. Pressures are as in the file, which does not say whether gauge or
/// absolute.
struct TirFile {
  std::string path;
  int version = 0;                          // FITTYP: 62 of Magic Formula 6.2; 0 where the file does not say
  double radius_m = 0.0;                    // UNLOADED_RADIUS
  double load_N = 0.0;                      // FNOMIN
  double speed_m_s = 0.0;                   // LONGVL
  std::optional<double> pressure_Pa;        // NOMPRES
  std::optional<double> stiffness_N_per_m;  // VERTICAL_STIFFNESS
  std::array<double, 8> coefficients{};     // QSY1 to QSY8
  double scale = 1.0;                       // LMY
  std::vector<std::string> warnings;

  /// Version 6.1 and later: coefficients 5 to 8 count.
  bool has_exponents() const { return version >= 61; }
};

/// Reads a file.
/// Errors   InputError: a key that is missing or no number, other units than meter, newton and second
/// Checked  tests/tables/tir_file_test.cpp
TirFile read_tir(const std::string& path);

/// Rolling resistance of a wheel that rolls freely on a flat surface, without camber.
/// Equation  F = M_y / r_l, M_y = R0 F0 LMY (QSY1 + QSY3 |V/V0| + QSY4 (V/V0)^4) (Fz/F0)^QSY7 (p/p0)^QSY8;
///           before version 6.1 Fz in the place of F0, and no factor of load and pressure
/// Symbols   R0 unloaded radius, r_l = R0 - Fz/Cz loaded radius, R0 where the file has no stiffness Cz; F0, p0, V0
///           nominal load, pressure and speed
/// Source    Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), (4.E70), with F0 as its first factor, as the solvers
///           have it: there, Fz would make QSY7 an exponent of RRc, and the force grow almost with the square of the
///           load
double calc_rolling_resistance_N(const TirFile& tir, double load_N, double pressure_Pa, double speed_m_s);

}  // namespace rollrig::tables
