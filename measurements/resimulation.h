#pragma once
/// A measured run simulated again from its recorded inputs.

#include "measurements/measurement_set.h"
#include "models/corner.h"
#include "rigs/rig_system.h"
#include "sim/program.h"
#include "sim/recording.h"

namespace rollrig::measurements {

/// What the equations take of a set's machine and tire. On the road a tire file may lack all but the constant
/// coefficient if that is the baseline: values of its class then stand in. Throws InputError where a vehicle on the
/// road is given by its road load, or a tire of the set or of an axle lacks a table.
models::Context<double> make_context(const MeasurementSet& set);

/// Load of a vehicle's tires, the mean of all.
double find_tire_load_N(const rigs::VehicleFile& vehicle);

/// A program that follows the recorded inputs of a run: straight lines between rows, a load held from row to row. Rows
/// are its samples.
///
/// Drum      rows that go on in a straight line are one segment
/// Others    a segment is one step of the integrator and does not lie across the middle between two rows. Of the
///           longitudinal force it has the root mean square, with the sign of its middle; the slope is the rise of the
///           road over the way between two rows
sim::Program make_recorded_program(const MeasuredRun& run, const MachineKind& kind);

/// A run made ready to be simulated, as often as wanted.
///
/// Axles     on the road each axle has its own load, tire and pressure; axles that are alike are simulated as one
///           corner. `corner` has the tire of the set, which axles without a tire of their own have: numbers moved in
///           it move there. Other axles keep the numbers of their tire's file. Effects act on all axles alike
/// Machine   drum and flat belt: rigs/quasi_static_drum.h by sim/stabilized_integrator.h, whose steps grow from 10 to
///           80 s where speed and load are held; dyno: rigs/recorded_roller.h, and road:
///           rigs/recorded_road.h, by the lagged midpoint rule. A drive right after another (tire_state = "warm")
///           begins at the temperature of steady driving at 80 km/h (Assumed)
/// Checked   tests/measurements/resimulation_test.cpp, tests/measurements/road_resimulation_test.cpp,
///           tests/measurements/road_axles_test.cpp
class Resimulation {
 public:
  Resimulation(const MeasuredRun& run, const MachineKind& kind);

  /// What the sensors would have shown, rows at the run's own times, trace effects applied; in full detail also what
  /// only a simulation knows. `set` and `run` are those that it was made for. Throws RunFailure.
  template <class S>
  sim::Recording<S> simulate(const MeasurementSet& set, const MeasuredRun& run, models::Corner<S>& corner,
                             rigs::Detail detail = rigs::Detail::kMeasured) const;

 private:
  sim::Program program_;
};

}  // namespace rollrig::measurements
