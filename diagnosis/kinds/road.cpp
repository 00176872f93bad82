/// Sets measured on the road: a vehicle whose traction force is known from its motor, and nothing of its tires.
#include <cmath>

#include "diagnosis/kinds/kinds.h"
#include "measurements/sample_selection.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr Quantity kTraction = models::quantities::kTractionForce;

class RoadKind : public MeasurementKind {
 public:
  /// The mean load of all tires, whatever the axles carry.
  void complete(const MeasurementSet& set, MeasuredRun& run) const override {
    run.columns[models::quantities::kLoad].assign(run.time_s.size(), measurements::find_tire_load_N(*set.vehicle));
  }

  ForceChannel force_channel(const MeasurementSet&) const override { return {"traction force", 1.0}; }

  std::vector<std::size_t> find_compared_rows(const MeasuredRun& run, const Quantity& channel) const override {
    const std::vector<double>& values = run.column(channel);
    const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (!std::isnan(values[row]) && speed_m_s[row] >= measurements::kTrustedSpeed_m_s) rows.push_back(row);
    }
    return rows;
  }

  std::vector<RunPhase> find_phases(const MeasurementSet&, const MeasuredRun& run) const override {
    return find_driving_phases(run);
  }

  double skim_limit_N(const MeasurementSet&) const override { return 0.0; }

  /// Against the constant coefficient nothing of the tire's heat is seen.
  Uncertainties find_uncertainties(const MeasurementSet& set, const models::Context<double>& context) const override {
    Uncertainties uncertainties;
    add_tire(set.tire, set.kind->make_rig().cooling_rig(), context, context.tire.model().info.loss_follows_heat,
             uncertainties);
    add_vehicle(*set.vehicle, uncertainties);
    return uncertainties;
  }

  std::vector<NamedPerturbation> perturbations() const override {
    return {{"rolling loss", Perturbation::kForce},
            {"inertia", Perturbation::kInertia},
            {"air drag", Perturbation::kDrag},
            {"tire heat", Perturbation::kTireHeat}};
  }

  /// That in which the runs began, on average.
  double usual_ambient_K(const MeasurementSet& set) const override {
    double sum_K = 0.0;
    for (const MeasuredRun& run : set.runs) sum_K += run.column(models::quantities::kAmbient).front();
    return sum_K / static_cast<double>(set.runs.size());
  }

  std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const override { return make_road_tests(set); }

  double calc_force_tolerance(const MeasurementSet& set, double simulated_N) const override {
    constexpr double kShareOfWeight = 0.02;  // Assumed, as kShare: a slope of 2 % beside the record, or its error
    constexpr double kShare = 0.3;
    return kShareOfWeight * set.vehicle->body.mass_kg * kStandardGravity_m_s2 + kShare * std::abs(simulated_N);
  }

  std::vector<WrongUnit> list_wrong_units() const override {
    std::vector<WrongUnit> wrong = list_common_wrong_units();
    wrong.push_back({kTraction, 3.6, 0.0, "is too small by a factor of 3.6"});
    wrong.push_back({kTraction, -1.0, 0.0, "has the other sign: positive drives"});
    wrong.push_back({kTraction, 1e3, 0.0, "holds kN"});
    wrong.push_back({models::quantities::kElevation, 0.3048, 0.0, "holds feet"});
    return wrong;
  }

  std::optional<double> find_tire_force_N(const MeasurementSet&, const MeasuredRun&, std::size_t,
                                          double) const override {
    return std::nullopt;
  }
};

}  // namespace

const MeasurementKind& road_kind() {
  static const RoadKind kind;
  return kind;
}

}  // namespace rollrig::diagnosis
