#pragma once
/// Energies of a test with sections as a measurement, for their uncertainty.

#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"
#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// Where result.json has consumption and range of a cycle.
struct ReportedCycle {
  std::string name;        // "city"; empty where the test has one kind of cycle
  std::string key_prefix;  // of the keys of its measurands: "city_"
  Json::json_pointer place;
  std::string consumption_key;  // direct current
  bool has_range = false;
};

/// Energy of the battery and of rolling resistance, over all sections of result.json; consumption of the `cycles`, their
/// range, and with a battery their consumption of alternating current. Each evaluation simulates the test again,
/// quasi-static and without sensors.
/// Equation  E = g E_sim(mass, T_amb, p, x_0 + S L z)
/// Symbols   g gain of the energy meter, for the battery and the consumption; a range is over 1/g where the
///           vehicle file gives the usable energy, and without g where the sections, by the same meter, give it. The
///           consumption of alternating current, energy of the recharge over range, is times g and times the gain of
///           the meter of the recharge; x
///           numbers of the tire file with a standard uncertainty, S these uncertainties, L L^T their correlation, z
///           independent inputs of standard deviation 1, T_amb and p air temperature and pressure of the tires
/// Validity  one tire file for all axles that are varied; the setting of the dynamometer stays as it is
/// Source    uncertainties of the tire file; others are assumed, and marked so
/// Checked   tests/scenarios/energy_uncertainty_test.cpp
estimation::MeasurementModel make_section_energy_model(const RunSpec& spec, const Json& settings,
                                                       const std::vector<ReportedCycle>& cycles);

}  // namespace rollrig::scenarios
