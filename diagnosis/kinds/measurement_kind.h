#pragma once
/// What the diagnosis asks of a kind of machine, of the sets measured on it: <word>.cpp beside this file, one for each
/// in rigs/machines.def. All other files of the diagnosis ask here and know no kind.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/checks/repairs.h"
#include "diagnosis/comparison/base_parameters.h"
#include "diagnosis/comparison/run_phases.h"
#include "diagnosis/findings/perturbations.h"
#include "diagnosis/next_test/test_menu.h"
#include "measurements/measurement_set.h"
#include "measurements/resimulation.h"

namespace rollrig::diagnosis {

/// The one channel of a kind that measures a force, which its traits name.
struct ForceChannel {
  std::string word;             // in messages: "torque"
  double newtons_per_SI = 1.0;  // as force at the surface
};

class MeasurementKind {
 public:
  virtual ~MeasurementKind() = default;

  /// Adds the columns that every method reads and that this kind does not record.
  virtual void complete(const measurements::MeasurementSet& /*set*/, measurements::MeasuredRun& /*run*/) const {}

  // What is compared, and how it is cut up.
  virtual ForceChannel force_channel(const measurements::MeasurementSet& set) const = 0;
  /// Rows of a channel that a comparison uses: those with a sample that the simulation can be held to.
  virtual std::vector<std::size_t> find_compared_rows(const measurements::MeasuredRun& run,
                                                      const Quantity& channel) const = 0;
  virtual std::vector<RunPhase> find_phases(const measurements::MeasurementSet& set,
                                            const measurements::MeasuredRun& run) const = 0;
  /// Load at or below which a tire is in skim; 0 where there is no skim.
  virtual double skim_limit_N(const measurements::MeasurementSet& set) const = 0;

  // What a recalibration may move, and which equations may need a perturbation.
  virtual Uncertainties find_uncertainties(const measurements::MeasurementSet& set,
                                           const models::Context<double>& context) const = 0;
  virtual std::vector<NamedPerturbation> perturbations() const = 0;

  // Which tests could come next, and in which air.
  virtual double usual_ambient_K(const measurements::MeasurementSet& set) const = 0;
  virtual std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const = 0;
  /// An ordinary run with every sensor that could be added; none where no sensor's reading is predicted.
  virtual std::optional<PlannedTest> make_sensor_test(const PreparedSet& /*set*/) const { return std::nullopt; }

  // Whether a set can be what it says it is.
  /// By how much the force channel may differ from its simulation, in SI units (plausibility.h).
  virtual double calc_force_tolerance(const measurements::MeasurementSet& set, double simulated) const = 0;
  /// Forces of numbers that are not known well, by row, in SI units: each as large as its standard deviation makes it.
  /// None where all of the force is known as its tolerance says.
  virtual std::vector<std::vector<double>> list_unknown_forces(const measurements::MeasurementSet& /*set*/,
                                                               const measurements::MeasuredRun& /*run*/) const {
    return {};
  }
  virtual std::vector<WrongUnit> list_wrong_units(const measurements::MeasurementSet& set) const = 0;
  /// Of a reading of the force channel what is the tire's; none where the rest is not known well enough.
  virtual std::optional<double> find_tire_force_N(const measurements::MeasurementSet& set,
                                                  const measurements::MeasuredRun& run, std::size_t row,
                                                  double reading) const = 0;
};

/// The kind of a set.
const MeasurementKind& kind_of(const measurements::MeasurementSet& set);

}  // namespace rollrig::diagnosis
