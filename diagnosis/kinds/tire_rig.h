#pragma once
/// Sets measured on a rig that presses one tire on a drum or a belt: load and speed set, the motor's torque or force
/// measured.

#include <cmath>

#include "diagnosis/kinds/kinds.h"
#include "measurements/sample_selection.h"
#include "models/parasitic_loss.h"
#include "scenarios/common/drum_conditions.h"

namespace rollrig::diagnosis {

class TireRigKind : public KindWithRig {
 public:
  /// How messages call the force channel.
  struct Words {
    const char* force;         // "torque"
    const char* perturbation;  // "drum torque"
    const char* kilo;          // its unit a thousand times as large
  };
  TireRigKind(const Quantity& force, const Words& words) : force_(force), words_(words) {}

  ForceChannel force_channel(const measurements::MeasurementSet& set) const override {
    return {words_.force, 1.0 / set.rig->lever_m()};
  }

  std::vector<std::size_t> find_compared_rows(const measurements::MeasuredRun& run,
                                              const Quantity& channel) const override {
    return measurements::find_compared_rows(run, channel);
  }

  std::vector<RunPhase> find_phases(const measurements::MeasurementSet& set,
                                    const measurements::MeasuredRun& run) const override {
    return diagnosis::find_phases(run, skim_limit_N(set));
  }

  double skim_limit_N(const measurements::MeasurementSet& set) const override {
    return scenarios::calc_skim_limit_N(*set.rig);
  }

  std::vector<NamedPerturbation> perturbations() const override {
    return {{words_.perturbation, Perturbation::kForce}, {"tire loss", Perturbation::kTireLoss},
            {"tire heat", Perturbation::kTireHeat},      {"gas heat", Perturbation::kGasHeat},
            {"gas mass", Perturbation::kGasMass},        {"boundary", Perturbation::kBoundary}};
  }

  std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const override { return make_drum_tests(set); }
  std::optional<PlannedTest> make_sensor_test(const PreparedSet& set) const override {
    return make_drum_sensor_test(set);
  }

  double calc_force_tolerance(const measurements::MeasurementSet& set, double simulated) const override {
    constexpr double kForce_N = 20.0;  // Assumed, as kShare: see RunMisfit
    constexpr double kShare = 0.3;
    return set.rig->lever_m() * kForce_N + kShare * std::abs(simulated);
  }

  /// A torque too large by a factor is not among them: bearings of a very cold rig come near it, and it is far outside
  /// all else anyway.
  std::vector<WrongUnit> list_wrong_units(const measurements::MeasurementSet& set) const override {
    std::vector<WrongUnit> wrong = list_common_wrong_units();
    wrong.push_back({force_, 1e3, 0.0, std::string("holds ") + words_.kilo});
    wrong.push_back({force_, 3.6, 0.0, "is too small by a factor of 3.6", 0.2});
    wrong.push_back({force_, -1.0, 0.0, "has the other sign: positive drives"});
    for (WrongUnit& one : list_mixed_up_lever(force_, set.rig->lever_m(), describe_force(*set.rig))) {
      wrong.push_back(std::move(one));
    }
    return wrong;
  }

  std::optional<double> find_tire_force_N(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                                          std::size_t row, double reading) const override {
    return reading / set.rig->lever_m() -
           models::calc_parasitic_N(set.rig->parasitic, run.column(models::quantities::kSpeed)[row]);
  }

 private:
  /// With a lever near 0.5 m, a torque is as much too large where the rig file has half of the drum's diameter.
  static std::string describe_force(const rigs::RigFile& rig) {
    constexpr double kNear = 0.2;  // Assumed: of the logarithm, by which neither can be told from the other
    const std::string force = "holds the force at the surface, in N";
    const bool is_near = models::is_drum(rig.kind->traits) && std::abs(std::log(2.0 * rig.lever_m())) < kNear;
    if (!is_near) return force;
    return force + fmt::format(", or the rig file has the radius of the drum as its diameter, {:g} m",
                               2.0 * rig.lever_m());
  }

  Quantity force_;
  Words words_;
};

}  // namespace rollrig::diagnosis
