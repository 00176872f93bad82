#pragma once
/// The coefficients of a road load by a procedure as a measurement, for their uncertainty.

#include "estimation/road_load/road_load_procedure.h"
#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// Scatter of the runs by the covariance of the procedure, and the sensors.
/// Equation  f = apply_sensor_errors(m + L k z, e)
/// Symbols   m coefficients as tested; J L L^T J^T covariance of the road load by the scatter of the runs, J Jacobian of the correction; k z as in make_scatter_inputs(), with the
///           fewest degrees of freedom of the three coefficients; e errors of the sensors
/// Validity  f1 has no budget where the procedure has no f1 (SAE J1263). K0 and the rotating mass are not among the
///           inputs, as in the intervals of the procedure
/// Source    the equations of correct_to_reference(); sensors: list_road_load_sensors()
/// Checked   tests/estimation/procedure_uncertainty_test.cpp
MeasurementModel make_procedure_model(const RoadLoadProcedure& procedure);

}  // namespace rollrig::estimation
