#pragma once
/// The ports: places in the chain of equations where an effect may act, in the order of evaluation.
///
/// One evaluation fills an Instant port by port. An effect's function for a port receives the Instant,
/// of which everything that stands before its port is filled, and the port itself, which it changes.
/// The gas port is filled before the loss port, because the loss law needs the pressure; it reads
/// inputs and boundary only.

#include <string>
#include <vector>

#include "models/machine_traits.h"
#include "models/parasitic_loss.h"
#include "models/tire/inflation_gas.h"
#include "models/tire/thermal_network.h"
#include "models/tire/tire.h"
#include "models/vehicle/road_load.h"

namespace rollrig::models {

/// What does not change in a run: the tire with its model, and the machine under it.
template <class S>
struct Context {
  TireParameters<S> tire;
  ParasiticParameters<S> parasitic;
  VehicleBody<S> vehicle;  // of a measured vehicle on the road; elsewhere a rig's layout has it
  MachineTraits machine{Surface::kDrum, Specimen::kTire, Restraint::kCarriage, quantities::kDrumTorque};
  S surface_curvature_per_m{};  // 1/R of drum or roller; 0 of a plane
  S machine_radius_m{};         // torque at the machine's axis over force at its surface; 1 of a belt, 0 on the road
  S machine_mass_kg{};          // inertia of drum, belt or roller as mass at its surface, J/R^2; 0 on the road
  S skim_load_N{};              // the rig's skim load
};

/// Port "input": what is recorded, on entry; what really acts, on exit.
template <class S>
struct InputPort {
  S speed_m_s{};  // of the surface
  S acceleration_m_s2{};
  S load_N{};
  S ambient_K{};
  S surface_K{};  // used where surface_recorded
  bool surface_recorded = false;
  S longitudinal_force_N{};  // wheel on roller or road, positive when it drives; zero on a drum rig
  S brake_force_N{};         // of this wheel's friction brake, at the surface, not negative; zero on a drum rig
  S slope{};                 // rise over run; zero on rigs
  S wind_m_s{};              // along the road, positive against the vehicle; zero on rigs
  S air_density_ratio{};     // to the reference density; 1 in the baseline
};

/// What the record shows of a true speed where that of the program is not followed, as while a rig coasts.
template <class S>
S calc_recorded_speed_m_s(const S& true_m_s, const InputPort<S>& recorded, const InputPort<S>& acting) {
  if (value_of(acting.speed_m_s) == value_of(recorded.speed_m_s)) return true_m_s;
  return true_m_s * (recorded.speed_m_s / acting.speed_m_s);
}

/// What the mechanics do at this instant: given by the multibody system, or by equilibrium.
template <class S>
struct Motion {
  S speed_m_s{};             // of the surface past the contact
  S acceleration_m_s2{};     // of the surface
  S load_N{};                // at the contact
  S longitudinal_force_N{};  // at the contact, on the wheel, in the direction of the surface's motion
  S slip_power_W{};          // dissipated by longitudinal slip
  S rolling_speed_m_s{};     // over which rolling resistance works: (omega_wheel + omega_drum) r_l/(1 + r_l/R),
                             // the surface speed but for slip
};

/// Port "boundary": surroundings of the tire.
template <class S>
struct BoundaryPort {
  S surface_K{};      // the recorded surface, or the ambient air where none is recorded
  S air_speed_m_s{};  // that carries heat off the tire; the surface speed in the baseline
};

/// Port "gas": the sealed cavity.
template <class S>
struct GasPort {
  S mass_ratio{};    // gas left, of what was filled in
  S volume_ratio{};  // volume, of that at which it was filled
};

/// Port "contact and inertia".
template <class S>
struct ContactPort {
  S slip_compliance_per_N{};   // 1/C of Fx = C slip; 0 = no slip loss, as in the baseline
  S machine_inertia_factor{};  // on the drum's or roller's inertia; 1 in the baseline
  S vehicle_mass_factor{};     // on the effective mass of a vehicle; 1 in the baseline
};

/// Port "loss": rolling resistance.
template <class S>
struct LossPort {
  S factor{};         // on the rolling resistance of the law; 1 in the baseline
  S temperature_K{};  // that the law sees; in the baseline that of the tire's model

  /// Adds a resisting force of the tire, of which `heat_share` heats the tire.
  void add_force(const S& force_N, const S& heat_share) {
    extra_force_N += force_N;
    extra_heating_force_N += force_N * heat_share;
  }
  /// Adds a resisting force of the tire, all of which heats the tire.
  void add_heating_force(const S& force_N) { add_force(force_N, S(1.0)); }

  S extra_force_N{};
  S extra_heating_force_N{};
};

/// Port "parasitic": loss of rig or vehicle beside the tire.
template <class S>
struct ParasiticPort {
  S factor{};         // on F_par; 1 in the baseline
  S extra_force_N{};  // at the surface
};

/// Port "thermal": the network itself, which the tire's model has filled.
template <class S>
using ThermalPort = ThermalNetwork<S>;

/// Everything at one instant.
template <class S>
struct Instant {
  const Context<S>* context = nullptr;
  Inflation<S> inflation;

  InputPort<S> recorded;
  InputPort<S> acting;
  Motion<S> motion;
  BoundaryPort<S> boundary;
  GasPort<S> gas;
  S pressure_Pa{};  // gauge
  ContactPort<S> contact;
  LossPort<S> loss;
  ParasiticPort<S> parasitic;
  ThermalPort<S> thermal;  // its temperatures are filled from the start

  S curvature_factor{};      // K of drum_curvature.h; 1 for a model that knows no curvature
  S rolling_resistance_N{};  // F_rr with every effect, faded at standstill
  S heating_force_N{};       // part of it that heats the tire
  S parasitic_N{};           // faded at standstill
  HeatFlows<S> heat;
};

/// Port "trace": the measured channels after a run, one row a sample.
template <class S>
struct TracePort {
  const Context<S>* context = nullptr;
  std::vector<double> time_s;
  std::vector<double> mean_bounds_s;  // where the mean of each row begins and that of the last ends; empty: half-way

  /// Where the mean of a row begins: that of the first at its time. Of one past the last row: where the last ends.
  double find_mean_start_s(std::size_t row) const {
    if (!mean_bounds_s.empty()) return mean_bounds_s[row];
    if (row == 0) return time_s.front();
    return row == time_s.size() ? time_s.back() : 0.5 * (time_s[row - 1] + time_s[row]);
  }

  struct Channel {
    Quantity quantity;
    std::vector<S> values;  // SI; NaN where there is no sample
  };
  std::vector<Channel> channels;

  /// The values of a channel, or nullptr where the run does not have it.
  std::vector<S>* find(const Quantity& quantity) {
    for (Channel& channel : channels) {
      if (channel.quantity == quantity) return &channel.values;
    }
    return nullptr;
  }
  /// The machine's force as it is measured, or nullptr.
  std::vector<S>* find_force() { return find(context->machine.force); }
  /// What a force at the surface is in that channel.
  S to_reading(const S& force_N) const {
    return reads_torque(context->machine) ? S(force_N / context->surface_curvature_per_m) : force_N;
  }
};

/// Port "initial state".
template <class S>
struct InitialPort {
  const Context<S>* context = nullptr;
  S tire_temperature_K{};     // of all nodes at the start
  S load_N{};                 // on the tire at the start, as recorded
  bool soaked = true;         // at rest so long that nothing remembers; formats.md's default
  S rest_before_s{};          // standstill before the run, where not soaked
  bool started_warm = false;  // right after another run (tire_state = "warm")
};

}  // namespace rollrig::models
