#pragma once
/// Perturbations on the balances of the baseline, as functions of a run's time: not effects of the catalog, but a probe
/// of which equation something is missing in.

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// Points of a run's time between which a perturbation is a straight line. Two at one time: it may jump there.
constexpr std::size_t kPerturbationKnots = 16;

/// Perturbations that there are; a kind of set names those that it can show (kinds/measurement_kind.h).
enum class Perturbation { kForce, kTireLoss, kTireHeat, kGasHeat, kGasMass, kBoundary, kSlip, kInertia, kDrag };
struct NamedPerturbation {
  std::string name;  // in reports
  Perturbation perturbation;
};

/// Derivatives of all block means by the sizes of one family of perturbations.
struct PerturbationFamily {
  std::string name;
  RowMatrix columns;  // by the perturbation at each knot of the row's own run; SI units
};

/// Knots of a run: both ends of each phase, and further ones where they lie farthest apart. Of a run of more phases
/// than half the knots, the shortest are joined with a neighbor.
std::vector<double> find_perturbation_knots(const PreparedRun& run);

/// Derivatives at the null by perturbations on each balance, a size of its own for each run and knot. Families: a force
/// at the surface that heats nothing (of a drum "drum torque": also the torque sensor), "tire loss" (force that heats
/// the rubber), "tire heat" (into the rubber node), "gas heat", "gas mass", "boundary" (ambient and surface
/// temperature), forces that go with the square of drive and brake force ("slip"), with acceleration ("inertia"), with
/// the square of speed ("air drag"), as far as the set's kind names them, and a sensor's own "temperature sensor",
/// "pressure sensor", "gas temperature sensor" where it is there.
/// Equation  perturbation = sum_i a_i hat_i(t), derivatives by a_i at 0, by forward differentiation of the resimulation
/// Errors    RunFailure: a run cannot be simulated at the null
/// Checked   tests/diagnosis/balance_test.cpp
std::vector<PerturbationFamily> calc_perturbations(const Study& study);

}  // namespace rollrig::diagnosis
