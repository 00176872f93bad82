#pragma once
/// The physics of tire and rig or vehicle, in equations of its own.
///
/// The same physics as rollrig's baseline in another form: the rubber is a wall of radial layers between tread
/// and liner, each with its own loss at its own temperature; the cavity holds an amount of gas with an internal
/// energy; the load cylinder settles after a step. Where the wall conducts well, all that is the baseline.

#include <cstddef>
#include <vector>

#include "validation/generator/campaign.h"
#include "validation/generator/effect.h"
#include "validation/generator/specimen.h"

namespace rollrig::generator {

/// How the rubber is laid out. Shares add to one over the layers, tread first.
struct Wall {
  std::size_t layers = 4;
  double conductance_W_per_K = 5e4;  // from tread to liner; such that the lumped limit holds
  double loss_skew = 0.0;            // share of the loss, linear over the layers: 0 even, 1 all towards the tread
  double tread_share_of_air = 1.0;   // of the cooling to the air; the rest leaves from the layer at the liner
};

/// What a laboratory could read at one instant, before its instruments.
struct Reading {
  double force_N = 0.0;  // at the surface of drum or roller; of the whole vehicle on the road; without inertia
  double liner_degC = 0.0;
  double pressure_kPa = 0.0;
};

class Plant {
 public:
  Plant(const Specimen& specimen, const Effects& effects, const RunPlan& run);

  std::size_t size() const { return size_; }
  std::vector<double> start() const;
  /// From now on `leg` holds; it may be asked beyond its end. The load comes from `load_before_N`, which
  /// changed at `load_step_s`.
  void enter(const Leg& leg, double load_before_N, double load_step_s);
  void calc_rates(double time_s, const double* state, double* rates) const;
  Reading read(double time_s, const double* state) const;
  double load_at(double time_s) const;
  double speed_at(double time_s) const;
  /// Inertia that the measured force has in it, as a mass at the surface: of drum and wheel, or of the vehicle.
  double moving_mass_kg(double load_N) const;
  /// Whether the friction brakes of a vehicle on the road act.
  bool friction_brakes_at(double time_s) const;

 private:
  Instant find_instant(double time_s, const double* state) const;
  double recorded_speed_at(double time_s) const;
  double vehicle_friction_N(double time_s) const;
  double calc_vehicle_N(const Instant& now) const;
  void find_losses(const double* state, Instant& now, std::vector<double>& layer_loss_N) const;

  const Specimen& specimen_;
  const Effects& effects_;
  const RunPlan& run_;
  Wall wall_;
  std::vector<double> loss_share_;
  std::size_t size_ = 0;
  std::vector<std::size_t> effect_state_;
  double gas_mol_ = 0.0;
  double cavity_m3_ = 0.0;
  double curvature_factor_ = 1.0;
  bool follows_law_ = true;  // of temperature, pressure and speed; else a constant coefficient
  Leg leg_;
  double load_before_N_ = 0.0;
  double load_step_s_ = 0.0;
};

}  // namespace rollrig::generator
