#pragma once
/// A road load without a measurement.

#include <string>
#include <vector>

#include <Eigen/Core>

namespace rollrig::estimation {

/// Default road load of the WLTP, in SI units.
/// Equation  f0 = 0.140 TM,  f1 = 0,  f2 = 2.8e-6 TM + 0.0170 w h   (N and km/h)
/// Symbols   TM test mass [kg]; w width, h height of the vehicle [m]
/// Validity  of use only where nothing was measured: it is meant to be high
/// Source    Regulation (EU) 2017/1151, 5.2.2 of Sub-Annex 4 (what f0 and f2 depend on, f1 = 0). The figures: UN GTR 15
///           Annex 4, 5.2.2, not read there; 2.8e-6 stands in slides of 2014 (slideplayer.com/slide/2522728)
/// Checked   tests/estimation/default_road_load_test.cpp
Eigen::Vector3d calc_default_road_load(double mass_kg, double width_m, double height_m);

/// A class of rolling resistance, with the value that the WLTP takes for all tires in it.
struct RrcClass {
  char label = 'A';            // of Regulation (EC) 1222/2009
  double most_N_per_kN = 0.0;  // infinite of the last one
  double value_N_per_kN = 0.0;
};

/// Classes of tires of C1, C2 or C3, by rising rolling resistance.
/// Source    limits: Regulation (EC) 1222/2009, Annex I Part A (legislation.gov.uk/eur/2009/1222/annex/I/part/1).
///           Values: UN GTR 15 Annex 4, table of 4.2.2.1 (not read there): the middle of the limits, to one decimal
/// Errors    InputError: another class of tires
/// Checked   tests/estimation/default_road_load_test.cpp
const std::vector<RrcClass>& list_rrc_classes(const std::string& tire_class);
const RrcClass& find_rrc_class(const std::string& tire_class, double rrc_N_per_kN);

}  // namespace rollrig::estimation
