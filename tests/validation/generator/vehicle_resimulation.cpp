#include "tests/validation/generator/vehicle_resimulation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "models/corner.h"
#include "models/vehicle/vehicle.h"
#include "sim/core/units.h"
#include "tests/support/machines.h"

namespace rollrig::tests {
namespace {

constexpr int kSubsteps = 4;  // of a second
constexpr double kAmbient_Pa = 101325.0;

using State = std::array<double, 2>;  // rubber, gas

models::Context<double> make_vehicle_context(const measurements::MeasurementSet& set) {
  if (set.rig.has_value()) return rigs::make_context(set.tire, *set.rig, set.baseline);
  models::Context<double> context;
  // A constant coefficient needs no more than the geometry, so the file may lack what a rig needs.
  const bool is_constant = set.baseline == models::Baseline::kConstantRrc;
  context.tire = is_constant ? set.tire.values : set.tire.parameters_on({""}, set.baseline);
  if (is_constant) context.tire.own = {&models::find_tire_model(models::kConstantModel), {}};
  context.machine = tests::kRoad->traits;
  return context;
}

/// One wheel and, on the road, the vehicle on it, with inputs linear between rows.
class VehicleResimulation {
 public:
  VehicleResimulation(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run)
      : set_(set), run_(run), corner_(make_vehicle_context(set), {}) {
    now_.recorded.air_density_ratio = 1.0;
    now_.inflation = {run.cold_pressure_Pa, run.initial_tire_temperature_K, kAmbient_Pa};
    state_ = {run.initial_tire_temperature_K, run.initial_tire_temperature_K};
    is_constant_ = set.baseline == models::Baseline::kConstantRrc;
  }

  std::map<std::string, std::vector<double>> take() {
    const std::size_t last = run_.time_s.size() - 1;
    for (std::size_t row = 0; row < last; ++row) march(row);
    visit(last - 1, kSubsteps);
    std::map<std::string, std::vector<double>> channels;
    channels[set_.kind == tests::kRoad ? "traction_force_N" : "loss_force_N"] = find_means(force_N_);
    channels["liner_temperature_degC"] = find_means(liner_K_);
    channels["cavity_pressure_kPa"] = find_means(pressure_Pa_);
    return channels;
  }

 private:
  double between(const char* column, std::size_t row, double part) const {
    const std::vector<double>& values = run_.columns.at(column);
    return values[row] + part * (values[row + 1] - values[row]);
  }

  void evaluate(std::size_t row, double part, const State& state) {
    const double dt_s = run_.time_s[row + 1] - run_.time_s[row];
    const std::vector<double>& speed_m_s = run_.columns.at("speed_km_h");
    now_.recorded.speed_m_s = between("speed_km_h", row, part);
    now_.recorded.acceleration_m_s2 = (speed_m_s[row + 1] - speed_m_s[row]) / dt_s;
    now_.recorded.ambient_K = now_.recorded.surface_K = between("ambient_degC", row, part);
    now_.recorded.load_N = set_.kind == tests::kRoad
                               ? set_.vehicle->body.mass_kg * kStandardGravity_m_s2 / set_.vehicle->count_wheels()
                               : run_.columns.at("load_N")[row];
    corner_.apply_inputs(state.data(), now_);
    now_.motion = {};
    now_.motion.speed_m_s = now_.motion.rolling_speed_m_s = now_.acting.speed_m_s;
    now_.motion.acceleration_m_s2 = now_.acting.acceleration_m_s2;
    now_.motion.load_N = now_.acting.load_N;
    corner_.calc_losses(state.data(), now_);
  }

  State find_rates(std::size_t row, double part, const State& state) {
    State rates{};
    if (is_constant_) return rates;  // such a tire has no temperature
    evaluate(row, part, state);
    corner_.calc_rates(state.data(), now_, rates.data());
    return rates;
  }

  double find_force_N(std::size_t row) const {
    if (set_.kind != tests::kRoad) return now_.rolling_resistance_N + now_.parasitic_N;
    const rigs::VehicleBody& body = set_.vehicle->body;
    const double way_m = 0.5 * (between("speed_km_h", row, 0.0) + between("speed_km_h", row, 1.0)) *
                         (run_.time_s[row + 1] - run_.time_s[row]);
    const std::vector<double>& elevation_m = run_.columns.at("elevation_m");
    const double slope = way_m > 0.0 ? (elevation_m[row + 1] - elevation_m[row]) / way_m : 0.0;
    const double density = models::calc_air_density_kg_per_m3(kAmbient_Pa, now_.acting.ambient_K);
    return set_.vehicle->count_wheels() * now_.rolling_resistance_N + models::calc_grade_N(body.mass_kg, slope) +
           models::calc_drag_N(density, body.drag_area_m2, now_.motion.speed_m_s, 0.0) +
           (body.mass_kg + body.rotating_mass_kg) * now_.motion.acceleration_m_s2;
  }

  void visit(std::size_t row, int step) {
    evaluate(row, static_cast<double>(step) / kSubsteps, state_);
    force_N_.push_back(find_force_N(row));
    liner_K_.push_back(state_[0]);
    pressure_Pa_.push_back(now_.pressure_Pa);
  }

  void march(std::size_t row) {
    const double dt_s = (run_.time_s[row + 1] - run_.time_s[row]) / kSubsteps;
    const double h = 1.0 / kSubsteps;
    const auto moved = [&](const State& rates, double by_s) {
      return State{state_[0] + by_s * rates[0], state_[1] + by_s * rates[1]};
    };
    for (int step = 0; step < kSubsteps; ++step) {
      visit(row, step);
      const double part = step * h;
      const State a = find_rates(row, part, state_);
      const State b = find_rates(row, part + 0.5 * h, moved(a, 0.5 * dt_s));
      const State c = find_rates(row, part + 0.5 * h, moved(b, 0.5 * dt_s));
      const State d = find_rates(row, part + h, moved(c, dt_s));
      for (std::size_t i = 0; i < 2; ++i) state_[i] += dt_s / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    }
    end_force_N_.push_back(force_at_end(row));
  }

  /// Just before the next row, where the acceleration is still the old one.
  double force_at_end(std::size_t row) {
    evaluate(row, 1.0, state_);
    return find_force_N(row);
  }

  /// Means over half a second on either side of each row, by Simpson's rule.
  std::vector<double> find_means(const std::vector<double>& values) const {
    const bool is_force = &values == &force_N_;
    std::vector<double> means;
    for (std::size_t row = 0; row < run_.time_s.size(); ++row) {
      const std::size_t at = row * kSubsteps;
      double sum = 0.0;
      double halves = 0.0;
      if (row > 0) {
        const double end = is_force ? end_force_N_[row - 1] : values[at];
        sum += (values[at - 2] + 4.0 * values[at - 1] + end) / 6.0;
        halves += 1.0;
      }
      if (row + 1 < run_.time_s.size()) {
        sum += (values[at] + 4.0 * values[at + 1] + values[at + 2]) / 6.0;
        halves += 1.0;
      }
      means.push_back(sum / halves);
    }
    return means;
  }

  const measurements::MeasurementSet& set_;
  const measurements::MeasuredRun& run_;
  models::Corner<double> corner_;
  models::Instant<double> now_;
  bool is_constant_ = false;
  State state_{};
  std::vector<double> force_N_;
  std::vector<double> liner_K_;
  std::vector<double> pressure_Pa_;
  std::vector<double> end_force_N_;  // just before each further row
};

}  // namespace

std::map<std::string, std::vector<double>> resimulate_vehicle(const measurements::MeasurementSet& set,
                                                              const measurements::MeasuredRun& run) {
  return VehicleResimulation(set, run).take();
}

}  // namespace rollrig::tests
