/// Sets measured on the road: a vehicle whose traction force is known from its motor, and nothing of its tires.
#include <cmath>

#include "diagnosis/kinds/kinds.h"
#include "measurements/sample_selection.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kAirDensity_kg_m3 = 1.2;  // near enough for a part that is not known
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

  /// Mass 10 %, height 10 %, drag 30 % off (wind), Assumed.
  std::vector<std::vector<double>> list_unknown_forces(const MeasurementSet& set,
                                                       const MeasuredRun& run) const override {
    constexpr double kMass = 0.1;
    constexpr double kHeight = 0.1;
    constexpr double kDrag = 0.3;
    constexpr double kSlowest_m_s = 1.0;
    const models::VehicleBody<double>& body = set.vehicle->body;
    const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
    const std::vector<double>& height_m = run.column(models::quantities::kElevation);
    std::vector<std::vector<double>> forces_N(3, std::vector<double>(speed_m_s.size(), 0.0));
    for (std::size_t row = 1; row < speed_m_s.size(); ++row) {
      const double duration_s = run.time_s[row] - run.time_s[row - 1];
      const double mean_m_s = 0.5 * (speed_m_s[row] + speed_m_s[row - 1]);
      const double rise_m = height_m[row] - height_m[row - 1];
      forces_N[0][row] = kMass * body.mass_kg * (speed_m_s[row] - speed_m_s[row - 1]) / duration_s;
      forces_N[1][row] = mean_m_s < kSlowest_m_s
                             ? 0.0
                             : kHeight * body.mass_kg * kStandardGravity_m_s2 * rise_m / (mean_m_s * duration_s);
      forces_N[2][row] = kDrag * 0.5 * kAirDensity_kg_m3 * body.drag_area_m2 * mean_m_s * mean_m_s;
    }
    return forces_N;
  }

  std::vector<WrongUnit> list_wrong_units(const MeasurementSet& set) const override {
    std::vector<WrongUnit> wrong = list_common_wrong_units();
    wrong.push_back({kTraction, 3.6, 0.0, "is too small by a factor of 3.6", 0.05});
    wrong.push_back({kTraction, -1.0, 0.0, "has the other sign: positive drives"});
    wrong.push_back({kTraction, 1e3, 0.0, "holds kN"});
    wrong.push_back({models::quantities::kElevation, 0.3048, 0.0, "holds feet"});
    const double radius_m = set.tire.values.geometry.outer_diameter_m / 2.0;
    for (WrongUnit& one : list_mixed_up_lever(kTraction, 1.0 / radius_m, "holds the torque at the wheels, in N m")) {
      wrong.push_back(std::move(one));
    }
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
