#include "tools/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "sim/core/csv.h"
#include "sim/core/parallel.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

using Load = models::RoadLoad<double>;

constexpr double kPound_kg = 0.45359237;                             // exact
constexpr double kPoundForce_N = kPound_kg * kStandardGravity_m_s2;  // exact
constexpr double kMile_per_h_m_s = 1609.344 / 3600.0;                // exact

const char* const kMake = "Represented Test Veh Make";
const char* const kModel = "Represented Test Veh Model";
const char* const kDrive = "Drive System Code";
const char* const kWeight = "Equivalent Test Weight (lbs.)";

std::vector<Load> read_loads(const CsvTable& table, const std::string& prefix) {
  const auto column = [&](const char* name) {
    const std::string key = prefix + name;
    return table.numbers({key.c_str(), any_number(), ""});
  };
  const std::vector<double> A = column(" Coef A (lbf)");
  const std::vector<double> B = column(" Coef B (lbf/mph)");
  const std::vector<double> C = column(" Coef C (lbf/mph**2)");
  std::vector<Load> loads;
  for (std::size_t i = 0; i < A.size(); ++i) {
    loads.push_back({kPoundForce_N * A[i], kPoundForce_N / kMile_per_h_m_s * B[i],
                     kPoundForce_N / (kMile_per_h_m_s * kMile_per_h_m_s) * C[i]});
  }
  return loads;
}

/// The three procedures, ready but for the car.
struct Procedures {
  scenarios::RunSpec road;
  scenarios::RunSpec all;
  scenarios::RunSpec driven;
  scenarios::RunSpec all_driveline;
  scenarios::RunSpec driven_driveline;
};

Procedures make_procedures(const FleetAssumptions& assumptions) {
  const double factor = find_loss_factor(assumptions.rrc_N_per_kN);
  const std::string pressure = fmt::format("pressure_kPa={}", assumptions.pressure_kPa);
  const std::vector<std::string> rollers{pressure};
  const std::vector<std::string> with_driveline{
      pressure, fmt::format("effects.driveline_warming.force_N={}", assumptions.driveline_cold_N),
      fmt::format("effects.driveline_warming.time_constant_min={}", assumptions.driveline_time_min),
      fmt::format("effects.driveline_warming.fall={}", assumptions.driveline_fall)};
  // On the road the car is given by its coefficients alone: no warm-up changes it.
  const auto setting = [](const char* rig, const std::vector<std::string>& settings) {
    return make_spec("dyno_setting", "a50", settings, {{"rig", rig}});
  };
  Procedures made{make_spec("coastdown", "a50", {"warm_up_min=0"}), setting("dyno_48in", rollers),
                  setting("dyno_48in_2wd", rollers), setting("dyno_48in", with_driveline),
                  setting("dyno_48in_2wd", with_driveline)};
  made.road.sample_interval_s = 0.1;
  for (scenarios::RunSpec* spec : {&made.road, &made.all, &made.driven, &made.all_driveline, &made.driven_driveline}) {
    scale_loss(spec->tire, factor);
  }
  return made;
}

double find_front_load(double front_drive) {  // Assumed: usual of such cars
  return front_drive == 1.0 ? 0.60 : front_drive == 0.0 ? 0.52 : 0.55;
}

/// A procedure with the car in it. The wheels' inertia goes with the car's mass, so that it stays within the
/// rotating mass.
scenarios::RunSpec put_car(const scenarios::RunSpec& procedure, const TestCar& car,
                           const FleetAssumptions& assumptions) {
  scenarios::RunSpec spec = procedure;
  rigs::VehicleFile& vehicle = *spec.vehicle;
  spec.tire.values.geometry.spin_inertia_kg_m2 *= car.mass_kg / vehicle.body.mass_kg;
  vehicle.name = car.make + " " + car.model;
  vehicle.body.mass_kg = car.mass_kg;
  vehicle.body.rotating_mass_kg = assumptions.rotating_share * car.mass_kg;
  rigs::VehicleAxle& front = vehicle.axles.front();
  rigs::VehicleAxle& rear = vehicle.axles.back();
  front.drive_share = find_front_drive(car.drive);
  front.load_share = find_front_load(front.drive_share);
  rear.drive_share = 1.0 - front.drive_share;
  rear.load_share = 1.0 - front.load_share;
  vehicle.road_load = car.target;
  return spec;
}

Load read_load(const Json& json, const std::string& prefix) {
  Load load;
  Load::visit(load, [&](const Field& field, double& value) {
    value = unit_of_key(field.key).to_si(json[prefix + field.key].get<double>());
  });
  return load;
}

void refit(const scenarios::RunSpec& spec, const TestCar& car, FleetResult& result) {
  result.refit = read_load(scenarios::run_scenario(spec, {}).result, "");
  for (int speed_km_h = 20; speed_km_h <= 130; ++speed_km_h) {
    const double speed_m_s = speed_km_h / 3.6;
    const double given_N = models::calc_road_load_N(car.target, speed_m_s);
    const double error = std::abs(models::calc_road_load_N(result.refit, speed_m_s) / given_N - 1.0);
    if (error <= result.refit_error) continue;
    result.refit_error = error;
    result.refit_error_at_m_s = speed_m_s;
  }
}

Load find_set(const scenarios::RunSpec& spec, FleetResult& result) {
  const Json json = scenarios::run_scenario(spec, {}).result;
  result.largest_off_N = std::max(result.largest_off_N, json["largest_difference_N"].get<double>());
  return read_load(json, "set_");
}

FleetResult simulate(const Procedures& procedures, const TestCar& car, const FleetAssumptions& assumptions) {
  FleetResult result;
  const bool driven_alone = find_front_drive(car.drive) != 0.5;
  try {
    refit(put_car(procedures.road, car, assumptions), car, result);
    result.set_all = find_set(put_car(procedures.all, car, assumptions), result);
    if (driven_alone) result.set_driven = find_set(put_car(procedures.driven, car, assumptions), result);
    const scenarios::RunSpec& last = driven_alone ? procedures.driven_driveline : procedures.all_driveline;
    result.set_driveline = find_set(put_car(last, car, assumptions), result);
  } catch (const RunFailure& failure) {
    result.failure = failure.what();
  }
  return result;
}

}  // namespace

std::vector<TestCar> read_test_cars(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  const std::vector<std::string> make = table.text(kMake);
  const std::vector<std::string> model = table.text(kModel);
  const std::vector<std::string> drive = table.text(kDrive);
  const std::vector<double> weight_lb = table.numbers({kWeight, positive(), ""});
  const std::vector<Load> target = read_loads(table, "Target");
  const std::vector<Load> set = read_loads(table, "Set");
  std::vector<TestCar> cars;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    const std::string key =
        fmt::format("{} {} {} {} {} {} {} {}", drive[i], weight_lb[i], target[i].A_N, target[i].B_N_s_per_m,
                    target[i].C_N_s2_per_m2, set[i].A_N, set[i].B_N_s_per_m, set[i].C_N_s2_per_m2);
    if (!seen.insert(key).second) continue;
    try {
      find_front_drive(drive[i]);
    } catch (const std::out_of_range&) {
      throw InputError({"unknown drive system", path, table.line_of(i), kDrive, drive[i], "F, R, A, 4 or P", ""});
    }
    cars.push_back({make[i], model[i], drive[i], kPound_kg * weight_lb[i], target[i], set[i]});
  }
  return cars;
}

double find_front_drive(const std::string& drive) {
  static const std::map<std::string, double> shares{{"F", 1.0}, {"R", 0.0}, {"P", 0.0}, {"A", 0.5}, {"4", 0.5}};
  return shares.at(drive);
}

std::vector<FleetResult> simulate_fleet(const std::vector<TestCar>& cars, const FleetAssumptions& assumptions,
                                        int threads) {
  const Procedures procedures = make_procedures(assumptions);
  std::vector<FleetResult> results(cars.size());
  parallel_for(cars.size(), threads, [&](std::size_t i) { results[i] = simulate(procedures, cars[i], assumptions); });
  return results;
}

std::string make_fleet_csv(const std::vector<TestCar>& cars, const std::vector<FleetResult>& results) {
  std::vector<std::string> columns{"make", "model", "drive", "mass_kg"};
  const std::array<const char*, 6> sources{"target",           "set", "refit", "sim_set_all", "sim_set_driven",
                                           "sim_set_driveline"};
  for (const char* source : sources) {
    Load load;
    Load::visit(load, [&](const Field& field, double&) { columns.push_back(fmt::format("{}_{}", source, field.key)); });
  }
  for (const char* name : {"refit_error_percent", "refit_error_at_km_h", "largest_off_N", "failure"}) {
    columns.emplace_back(name);
  }
  using Rounded = CsvWriter::Rounded;
  CsvWriter csv(columns);
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const FleetResult& result = results[i];
    for (const std::string& text : {cars[i].make, cars[i].model, cars[i].drive}) csv.add(text);
    csv.add(Rounded{cars[i].mass_kg, 7});
    const auto add = [&csv](const std::optional<Load>& given) {
      const Load load = given.value_or(Load{NAN, NAN, NAN});
      Load::visit(load, [&](const Field& field, const double& value) {
        csv.add(Rounded{unit_of_key(field.key).from_si(value), 6});
      });
    };
    add(cars[i].target);
    add(cars[i].set);
    add(result.refit);
    add(result.set_all);
    add(result.set_driven);
    add(result.set_driveline);
    csv.add_row(Rounded{100.0 * result.refit_error, 3}, Rounded{3.6 * result.refit_error_at_m_s, 4},
                Rounded{result.largest_off_N, 4}, result.failure);
  }
  return csv.take();
}

}  // namespace rollrig::tools
