#pragma once
/// f0, f1 and f2 of a procedure as a measurement, for their uncertainty.

#include "estimation/road_load/road_load_procedure.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// Scatter of the runs by the covariance of the procedure, and the sensors.
/// Equation  f = calc_road_load(m + L k z, e),  J L L^T J^T the covariance of the road load by the scatter of the runs
/// Symbols   m coefficients as tested; J what the correction makes of them; k z as in make_scatter_inputs(), with the
///           fewest degrees of freedom of the three coefficients; e errors of the sensors
/// Validity  K0 and the rotating mass are not among the inputs, as in the intervals of the procedure
/// Source    the equations of correct_to_reference(); sensors: list_road_load_sensors()
/// Checked   tests/estimation/procedure_uncertainty_test.cpp
MeasurementModel make_procedure_model(const RoadLoadProcedure& procedure);

}  // namespace rollrig::estimation
