/// Sets measured on a dynamometer: one wheel of a vehicle on its roller; its loss and its tire are measured.
#include <cmath>

#include "diagnosis/kinds/kinds.h"
#include "measurements/sample_selection.h"
#include "models/parasitic_loss.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr Quantity kLoss = models::quantities::kLossForce;

class DynoKind : public KindWithRig {
 public:
  ForceChannel force_channel(const MeasurementSet&) const override { return {"loss force", 1.0}; }

  /// The loss is compensated for inertia, so that speed changes count; below 20 km/h and within 30 s of a load change
  /// it does not.
  std::vector<std::size_t> find_compared_rows(const MeasuredRun& run, const Quantity& channel) const override {
    const std::vector<double>& values = run.column(channel);
    const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
    std::vector<std::size_t> rows;
    double settled_s = run.time_s.front();
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (measurements::is_load_change(run, row)) settled_s = run.time_s[row] + measurements::kSettling_s;
      const bool trusted =
          channel != kLoss || (speed_m_s[row] >= measurements::kTrustedSpeed_m_s && run.time_s[row] >= settled_s);
      if (!std::isnan(values[row]) && trusted) rows.push_back(row);
    }
    return rows;
  }

  std::vector<RunPhase> find_phases(const MeasurementSet&, const MeasuredRun& run) const override {
    return find_driving_phases(run);
  }

  double skim_limit_N(const MeasurementSet&) const override { return 0.0; }

  std::vector<NamedPerturbation> perturbations() const override {
    return {{"loss force", Perturbation::kForce},   {"tire loss", Perturbation::kTireLoss},
            {"tire heat", Perturbation::kTireHeat}, {"gas heat", Perturbation::kGasHeat},
            {"gas mass", Perturbation::kGasMass},   {"slip", Perturbation::kSlip},
            {"inertia", Perturbation::kInertia},    {"boundary", Perturbation::kBoundary}};
  }

  std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const override { return make_dyno_tests(set); }

  double calc_force_tolerance(const MeasurementSet&, double simulated_N) const override {
    constexpr double kForce_N = 40.0;  // Assumed, as kShare: driveline, brake drag and drive force (RunMisfit)
    constexpr double kShare = 0.3;
    return kForce_N + kShare * std::abs(simulated_N);
  }

  std::vector<WrongUnit> list_wrong_units(const MeasurementSet& set) const override {
    std::vector<WrongUnit> wrong = list_common_wrong_units();
    wrong.push_back({kLoss, 1e3, 0.0, "holds kN"});
    wrong.push_back({kLoss, 3.6, 0.0, "is too small by a factor of 3.6", 0.2});
    wrong.push_back({kLoss, -1.0, 0.0, "has the other sign: a loss is positive"});
    const double radius_m = set.tire.values.geometry.outer_diameter_m / 2.0;
    for (WrongUnit& one : list_mixed_up_lever(kLoss, 1.0 / radius_m, "holds the torque at the wheel, in N m")) {
      wrong.push_back(std::move(one));
    }
    for (WrongUnit& one :
         list_mixed_up_lever(kLoss, 1.0 / set.rig->lever_m(), "holds the torque at the roller, in N m")) {
      wrong.push_back(std::move(one));
    }
    return wrong;
  }

  std::optional<double> find_tire_force_N(const MeasurementSet& set, const MeasuredRun& run, std::size_t row,
                                          double loss_N) const override {
    return loss_N - models::calc_parasitic_N(set.rig->parasitic, run.column(models::quantities::kSpeed)[row]);
  }
};

}  // namespace

const MeasurementKind& dyno_kind() {
  static const DynoKind kind;
  return kind;
}

}  // namespace rollrig::diagnosis
