/// Sets measured on a drum rig: one tire, load and speed set, the motor's torque measured.
#include <cmath>

#include "diagnosis/kinds/kind_with_rig.h"
#include "diagnosis/kinds/kinds.h"
#include "measurements/sample_selection.h"
#include "models/parasitic_loss.h"
#include "scenarios/common/drum_conditions.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

class DrumKind : public KindWithRig {
 public:
  ForceChannel force_channel(const MeasurementSet& set) const override {
    return {"drum_torque_Nm", "torque", 2.0 / set.rig->drum.diameter_m};
  }

  std::vector<std::size_t> find_compared_rows(const MeasuredRun& run, const std::string& channel) const override {
    return measurements::find_compared_rows(run, channel);
  }

  std::vector<RunPhase> find_phases(const MeasurementSet& set, const MeasuredRun& run) const override {
    return diagnosis::find_phases(run, skim_limit_N(set));
  }

  double skim_limit_N(const MeasurementSet& set) const override { return scenarios::calc_skim_limit_N(*set.rig); }

  std::vector<NamedPerturbation> perturbations() const override {
    return {{"drum torque", Perturbation::kForce},  {"tire loss", Perturbation::kTireLoss},
            {"tire heat", Perturbation::kTireHeat}, {"gas heat", Perturbation::kGasHeat},
            {"gas mass", Perturbation::kGasMass},   {"boundary", Perturbation::kBoundary}};
  }

  std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const override { return make_drum_tests(set); }
  std::optional<PlannedTest> make_sensor_test(const PreparedSet& set) const override {
    return make_drum_sensor_test(set);
  }

  double calc_force_tolerance(const MeasurementSet& set, double simulated) const override {
    constexpr double kForce_N = 20.0;  // Assumed, as kShare: see RunMisfit
    constexpr double kShare = 0.3;
    return 0.5 * set.rig->drum.diameter_m * kForce_N + kShare * std::abs(simulated);
  }

  /// A torque too large by a factor is not among them: bearings of a very cold rig come near it, and it is far outside
  /// all else anyway.
  std::vector<WrongUnit> list_wrong_units() const override {
    std::vector<WrongUnit> wrong = list_common_wrong_units();
    wrong.push_back({"drum_torque_Nm", 1e3, 0.0, "holds kN m"});
    wrong.push_back({"drum_torque_Nm", 3.6, 0.0, "is too small by a factor of 3.6"});
    wrong.push_back({"drum_torque_Nm", -1.0, 0.0, "has the other sign: positive drives"});
    return wrong;
  }

  std::optional<double> find_tire_force_N(const MeasurementSet& set, const MeasuredRun& run, std::size_t row,
                                          double torque_Nm) const override {
    const double radius_m = 0.5 * set.rig->drum.diameter_m;
    return torque_Nm / radius_m - models::calc_parasitic_N(set.rig->parasitic, run.columns.at("speed_km_h")[row]);
  }
};

}  // namespace

const MeasurementKind& drum_kind() {
  static const DrumKind kind;
  return kind;
}

}  // namespace rollrig::diagnosis
