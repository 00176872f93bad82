#pragma once
/// Rolling resistance by the deceleration method as a measurement, for its uncertainty.

#include "estimation/drum_deceleration/drum_coastdown.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// At the speed asked for that is nearest to the reference speed: the rolling resistance at each pressure and load (the
/// net deceleration where the inertia of the drum is not known), and the exponent of pressure of the runs at one load.
/// Equation  as models::calc_net_deceleration, times I_D/R^2, with
///           a = (1 + g) (a_m + s e_i/sqrt(n)), a_D0 and a_T0 likewise with errors of their own; exponent: slope of
///           ln(F) over ln(p + d), with the levels' scatter about it
/// Symbols   a_m mean over the n loaded runs of a level [m/s^2]; s scatter from run to run, pooled over the levels; e_i
///           of standard deviation 1; g relative error of the deceleration from that of the speed [1]; d error of the
///           pressure [Pa]; others as in calc_net_deceleration
/// Validity  errors of instruments and scatter from run to run. The scatter within a run stands in where no pressure
///           was run twice. The law's lack of fit counts in the exponent alone; of two pressures, which have none, the
///           scatter of the runs
/// Source    accuracies of instruments are assumed, as those of ISO 28580 (scenarios/common/iso_uncertainty.h)
/// Errors    InputError: no result at that speed
/// Checked   tests/estimation/coast_uncertainty_test.cpp
MeasurementModel make_coast_model(const CoastSet& set, const DrumCoastdownFit& fit);

}  // namespace rollrig::estimation
