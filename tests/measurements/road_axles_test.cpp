// Vehicles with different axles on the road, simulated again from recorded inputs.
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "measurements/resimulation.h"
#include "sim/core/assets.h"
#include "sim/energy_audit.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using models::Baseline;
using Effects = std::vector<models::ActiveEffect>;

namespace {

constexpr double kSpeed_m_s = 80.0 / 3.6;
constexpr double kAir_K = 293.15;
constexpr double kMass_kg = 2000.0;
constexpr double kDragArea_m2 = 0.7;
constexpr double kWeight_N = kMass_kg * kStandardGravity_m_s2;
constexpr double kFrontShare = 0.62;

struct Axle {
  double load_share;
  int wheels = 2;
};

rigs::VehicleFile make_vehicle(const std::vector<Axle>& axles) {
  std::string text = "format = \"rollrig-vehicle/2\"\nname = \"car\"\nmass_kg = " + std::to_string(kMass_kg) +
                     "\nrotating_mass_kg = 70\ndrag_area_m2 = " + std::to_string(kDragArea_m2) + "\n";
  for (std::size_t i = 0; i < axles.size(); ++i) {
    const std::string first = i == 0 ? "1.0" : "0.0";
    text += "[[axle]]\nposition_m = " + std::to_string(i) + ".0\nload_share = " + std::to_string(axles[i].load_share) +
            "\ndrive_share = " + first + "\nbrake_share = " + first + "\nwheels = " + std::to_string(axles[i].wheels) +
            "\n";
  }
  return rigs::read_vehicle(parse_config(text, "car.toml"));
}

/// A level run at one speed, of the vehicle with these axles.
MeasurementSet make_steady_set(Baseline baseline, const std::vector<Axle>& axles) {
  static const MeasurementSet constant = tests::make_road_set({}, 1);
  static const MeasurementSet combined = tests::make_road_set({}, 1, Baseline::kCombined);
  MeasurementSet set = baseline == Baseline::kCombined ? combined : constant;
  set.vehicle = make_vehicle(axles);
  MeasuredRun& run = set.runs.front();
  run = {};
  run.id = "steady";
  run.initial_tire_temperature_K = kAir_K;
  run.cold_pressure_Pa = 250e3;
  for (int i = 0; i <= 900; ++i) run.time_s.push_back(10.0 * i);
  run.columns["speed_km_h"].assign(run.time_s.size(), kSpeed_m_s);
  run.columns["elevation_m"].assign(run.time_s.size(), 0.0);
  run.columns["ambient_degC"].assign(run.time_s.size(), kAir_K);
  return set;
}

template <class S = double>
sim::Recording<S> simulate_axles(const MeasurementSet& set, const Effects& effects = {},
                                 rigs::Detail detail = rigs::Detail::kMeasured) {
  models::Corner<S> corner(models::convert_context<S>(measurements::make_context(set)), effects);
  const MeasuredRun& run = set.runs.front();
  return measurements::Resimulation(run, *set.kind).simulate(set, run, corner, detail);
}

std::vector<double> find_traction_N(const MeasurementSet& set, const Effects& effects = {}) {
  return simulate_axles(set, effects).channel("traction_force_N");
}

double calc_car_drag_N() {
  return 0.5 * kStandardAtmosphere_Pa / (287.05 * kAir_K) * kDragArea_m2 * kSpeed_m_s * kSpeed_m_s;
}

/// Loss of one tire in the steady state: the law at the temperature that its own heat gives it.
double calc_steady_loss_N(const models::TireFile& tire, double load_N, double cold_pressure_Pa) {
  const auto& law = tire.values.rolling_resistance;
  const auto& thermal = tire.values.thermal;
  double loss_N = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double warm_K =
        kAir_K +
        loss_N * kSpeed_m_s / (thermal.rest_conductance_W_per_K + thermal.speed_conductance_W_s_per_m_K * kSpeed_m_s);
    const double pressure_Pa = (cold_pressure_Pa + kStandardAtmosphere_Pa) * warm_K / kAir_K - kStandardAtmosphere_Pa;
    loss_N = std::pow(pressure_Pa / law.reference_pressure_Pa, -law.pressure_exponent) * load_N / law.reference_load_N *
             (law.A0_N + law.A1_N_s_per_m * kSpeed_m_s) *
             std::exp(-(law.B0_per_K + law.B1_s_per_m_K * kSpeed_m_s) * (warm_K - kZeroCelsius_K));
  }
  return loss_N;
}

}  // namespace

TEST_CASE("each axle loses what its own load, tire and pressure make it lose in the steady state", "[fast]") {
  MeasurementSet set = make_steady_set(Baseline::kCombined, {{kFrontShare}, {1.0 - kFrontShare}});
  set.tire.values.rolling_resistance.reference_drum_diameter_m = 1e9;  // the law holds on the road as it is
  models::TireFile rear_tire = set.tire;
  rear_tire.values.rolling_resistance.A0_N *= 1.3;
  rear_tire.values.thermal.rest_conductance_W_per_K *= 0.6;
  for (const bool own_tire : {false, true}) {
    set.vehicle->axles[0].pressure_Pa = 300e3;
    if (own_tire) set.vehicle->axles[1].tire = rear_tire;
    const double front_N = 2.0 * calc_steady_loss_N(set.tire, 0.5 * kFrontShare * kWeight_N, 300e3);
    const double rear_N =
        2.0 * calc_steady_loss_N(own_tire ? rear_tire : set.tire, 0.5 * (1.0 - kFrontShare) * kWeight_N, 250e3);
    const double mean_N = 4.0 * calc_steady_loss_N(set.tire, 0.25 * kWeight_N, 275e3);
    REQUIRE(std::abs(front_N + rear_N - mean_N) > 1.0);
    CHECK(find_traction_N(set)[800] ==
          Approx(front_N + rear_N + calc_car_drag_N()).epsilon(1e-5));  // 14 time constants
    MeasurementSet warm = set;
    warm.runs.front().started_warm = true;
    const double off_N = std::abs(find_traction_N(warm)[1] - find_traction_N(set)[800]);
    CHECK(off_N < 0.2 * std::abs(find_traction_N(set)[1] - find_traction_N(set)[800]));
  }
}

TEST_CASE("equal axles are simulated as one, to the last bit", "[fast]") {
  MeasurementSet set = tests::make_road_set({}, 1, Baseline::kCombined);
  const Effects effects{tests::make_active(models::find_effect("slip_loss"), {0.01e-3})};
  const auto with = [&](const std::vector<Axle>& axles) {
    set.vehicle = make_vehicle(axles);
    return find_traction_N(set, effects);
  };
  for (const bool warm : {false, true}) {
    set.runs.front().started_warm = warm;
    const std::vector<double> one = with({{1.0, 4}});
    CHECK(with({{0.5}, {0.5}}) == one);
    CHECK(with({{0.25, 1}, {0.25, 1}, {0.5, 2}}) == one);
    CHECK(with({{0.333333}, {0.333333}, {0.333334}}) == with({{1.0, 6}}));
    set.vehicle = make_vehicle({{0.5}, {0.5}});
    set.vehicle->axles[1].tire = set.tire;  // two corners with the same numbers
    REQUIRE(rigs::group_tires(*set.vehicle, 250e3).size() == 2);
    const std::vector<double> two = find_traction_N(set, effects);
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(two[i] == Approx(one[i]).epsilon(1e-12).margin(1e-9));
    rigs::share_tire(set.tire, *set.vehicle);
    CHECK(find_traction_N(set, effects) == one);
  }
}

TEST_CASE("a tire's coefficient counts by the share of the weight on its axle", "[fast]") {
  constexpr double kMore = 1e-3;
  MeasurementSet set = make_steady_set(Baseline::kConstantRrc, {{kFrontShare}, {1.0 - kFrontShare}});
  models::TireFile& rear = set.vehicle->axles[1].tire.emplace(set.tire);
  rear.values.constant.rrc = 0.0082;
  const double before_N = find_traction_N(set)[10];
  CHECK(before_N == Approx((kFrontShare * set.tire.values.constant.rrc + (1.0 - kFrontShare) * 0.0082) * kWeight_N +
                           calc_car_drag_N()));
  // An effect acts on the tires of both axles: four times its force.
  const Effects drag{tests::make_active(models::find_effect("toe_camber_drag"), {7.0, 0.0, 0.0})};
  CHECK(find_traction_N(set, drag)[10] - before_N == Approx(28.0));
  rear.values.constant.rrc += kMore;
  CHECK(find_traction_N(set)[10] - before_N == Approx((1.0 - kFrontShare) * kMore * kWeight_N));
}

TEST_CASE("a diagnosis moves the numbers of the set's tire, on the axles that have it", "[fast]") {
  MeasurementSet set = make_steady_set(Baseline::kConstantRrc, {{kFrontShare}, {1.0 - kFrontShare}});
  set.vehicle->axles[1].tire = set.tire;
  for (const bool is_shared : {false, true}) {
    if (is_shared) rigs::share_tire(set.tire, *set.vehicle);
    models::Context<Jet> context = models::convert_context<Jet>(measurements::make_context(set));
    context.tire.constant.rrc.v[0] = 1.0;
    context.vehicle.mass_kg.v[1] = 1.0;
    models::Corner<Jet> corner(context, {});
    const MeasuredRun& run = set.runs.front();
    const Jet force_N =
        measurements::Resimulation(run, *set.kind).simulate(set, run, corner).channel("traction_force_N")[10];
    CHECK(force_N.v[0] == Approx((is_shared ? 1.0 : kFrontShare) * kWeight_N));
    CHECK(force_N.v[1] == Approx(set.tire.values.constant.rrc * kStandardGravity_m_s2));
  }
}

TEST_CASE("energy closes with axles that differ, and channels of a tire are means over all", "[fast]") {
  MeasurementSet set = tests::make_road_set({}, 1, Baseline::kCombined);
  set.vehicle = make_vehicle({{kFrontShare}, {1.0 - kFrontShare, 4}});
  set.vehicle->axles[0].pressure_Pa = 300e3;
  set.vehicle->axles[1].tire = models::read_tire(read_config(find_asset("tires", "a40")));
  const Effects effects{tests::make_active(models::find_effect("slip_loss"), {0.01e-3})};
  const auto recording = simulate_axles(set, effects, rigs::Detail::kFull);
  CHECK(recording.audit.find_largest_J() > 1e5);
  CHECK(std::abs(recording.audit.calc_closure(sim::EnergyTerm::Ledger::kMechanical)) < 1e-7);
  CHECK(std::abs(recording.audit.calc_closure(sim::EnergyTerm::Ledger::kThermal)) < 1e-7);
  CHECK(recording.channel("cavity_pressure_kPa")[0] == Approx((2.0 * 300e3 + 4.0 * 250e3) / 6.0).epsilon(1e-3));
  CHECK(recording.channel("traction_force_N") == find_traction_N(set, effects));
}

TEST_CASE("a set of the old form has equal loads on all tires, and the results that it had", "[fast]") {
  MeasurementSet set = measurements::read_measurement_set(ROLLRIG_SOURCE_DIR "/tests/measurements/old_form/road");
  CHECK(rigs::group_tires(*set.vehicle, 250e3).size() == 1);
  const std::vector<double> found_N = find_traction_N(set);
  const std::vector<double> were_N{3935.3741487712091, 4324.4004651447658, 4679.9515137765866, 4646.4762460348502};
  REQUIRE(found_N.size() == were_N.size());
  for (std::size_t i = 0; i < were_N.size(); ++i) CHECK(found_N[i] == Approx(were_N[i]).epsilon(1e-13));
  const std::string three =
      "format = \"rollrig-vehicle/1\"\nname = \"trike\"\nmass_kg = 600\nrotating_mass_kg = 20\ndrag_area_m2 = 0.6\n"
      "tires = 3\n";
  set.vehicle = rigs::read_vehicle(parse_config(three, "car.toml"));
  REQUIRE(rigs::group_tires(*set.vehicle, 250e3).size() == 1);
  CHECK(rigs::group_tires(*set.vehicle, 250e3).front().count == 3);
}
