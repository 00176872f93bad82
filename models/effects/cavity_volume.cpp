/// The cavity of the tire becomes smaller under load and larger with speed.
#include <array>
#include <vector>

#include "models/effect.h"

namespace rollrig::models::cavity_volume {

struct CavityVolume {
  enum Parameter { kContraction, kLoadPower, kGrowth, kSetting, kSettling };
  enum State { kFelt };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "cavity_volume";
    info.summary =
        "The deflection at the contact makes the cavity smaller, the centrifugal force makes it larger: the pressure "
        "steps with load and speed";
    info.equation =
        "V/V_0 = w = 1 - e ((Fz/Fz_ref)^m - l - q (v/v_1)^2), v_1 = 120 km/h; a change of volume warms or cools the "
        "gas by dT/T = -(kappa - 1) dw, which goes into the rubber: p ~ T_gas (1 - (kappa - 1) (w - w_f))/w, dw_f/dt "
        "= (w - w_f) H/C_gas. The cavity follows the recorded load and speed with the time constant t_l: the "
        "reading of p is lower by p kappa d, dd/dt = -dw/dt - d/t_l";
    info.source =
        "Assumed: e up to 1 %, as the contact presses in some 0.4 l of 40 l; m about 1, q up to 1, the square "
        "(centrifugal force), l from 0 (pressure set on the lifted wheel) to 1 (on the loaded one). Heat of "
        "compression: ideal gas, kappa = 1.4; what it heats the rubber by is nothing beside the rubber's own loss. "
        "The run starts in equilibrium under its first load, at rest. Assumed: t_l 0.2 to 1.5 s, of a load cylinder "
        "and of a logger that samples pressure and load half a second apart";
    info.parameters = {
        {"contraction_percent",
         between(-5.0, 10.0),
         {0.1, 1.0, Prior::Scale::kLog},
         "e, of the volume, from no load to the reference load",
         0.0},
        {"load_power", between(0.3, 3.0), {0.8, 1.5}, "m, of the load"},
        {"growth_ratio", between(-2.0, 5.0), {0.1, 0.9}, "q, growth at 120 km/h relative to e"},
        {"setting_ratio", between(-2.0, 3.0), {0.0, 1.0}, "l, contraction at which the pressure was set, of e"},
        {"settling_s",
         between(0.01, 5.0),
         {0.2, 1.5, Prior::Scale::kLog},
         "t_l, by which the cavity follows the recorded load and speed"}};
    info.states = {{"felt_volume", 0.01, "w_f - 1, volume over that at filling that the gas has come to terms with"}};
    info.faint_on = &is_on_road;                      // one load, no pressure channel
    info.visible_in = {quantities::kCavityPressure};  // the loss follows by half a percent at most
    info.splitting_tests = {"load off and on at constant liner temperature, pressure logged",
                            "pressure at standstill at several loads"};
    return info;
  }

  static constexpr double kKappaLessOne = 0.4;  // of a gas of two atoms

  /// (Fz/Fz_ref)^m.
  template <class S>
  static S calc_pressed(const EffectView<S>& self, const Context<S>& context, const S& load_N) {
    using std::pow;
    const S load_ratio = load_N / context.tire.rolling_resistance.reference_load_N;
    return value_of(load_ratio) > 0.0 ? S(pow(load_ratio, self.parameter(kLoadPower))) : S(0.0);
  }

  /// w - 1.
  template <class S>
  static S calc_change(const EffectView<S>& self, const Context<S>& context, const S& load_N, const S& speed_m_s) {
    const S speed_ratio = speed_m_s / quantity<S>(120.0 / 3.6, dimension::kSpeed);
    const S contraction = calc_pressed(self, context, load_N) - self.parameter(kSetting) -
                          self.parameter(kGrowth) * speed_ratio * speed_ratio;
    return -self.parameter(kContraction) * contraction;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kFelt] = calc_change(self, *port.context, port.load_N, quantity<S>(0.0, dimension::kSpeed));
  }

  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>& now, GasPort<S>& port) {
    const S change = calc_change(self, *now.context, now.motion.load_N, now.motion.speed_m_s);
    const S warmer = kKappaLessOne * (self.state(kFelt) - change);
    port.volume_ratio *= (S(1.0) + change) / (S(1.0) + warmer);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    const std::size_t gas = index_of(Node::kGas);
    const S change = calc_change(self, *now.context, now.motion.load_N, now.motion.speed_m_s);
    rates[kFelt] = (change - self.state(kFelt)) * now.thermal.link_W_per_K[index_of(Node::kLiner)][gas] /
                   now.thermal.heat_capacity_J_per_K[gas];
  }

  /// Mean of d over each row's cell (half-way to its neighbors). A recorded load holds until the next row, a speed goes
  /// straight to it.
  /// Equation  between two rows  d(t) = (d_0 - g t_l) exp(-t/t_l) + g t_l, g the slope of w by the speed
  template <class S>
  static std::vector<S> calc_lacking(const EffectView<S>& self, const TracePort<S>& port, const std::vector<S>& load_N,
                                     const std::vector<S>& speed_m_s) {
    using std::exp;
    const S time_constant_s = self.parameter(kSettling);
    const auto change_at = [&](std::size_t of_load, std::size_t of_speed) {
      return calc_change(self, *port.context, load_N[of_load], speed_m_s[of_speed]);
    };
    std::vector<S> integral(load_N.size(), zero<S>());
    S lacking = zero<S>();
    for (std::size_t row = 0; row + 1 < load_N.size(); ++row) {
      if (row > 0) lacking += change_at(row - 1, row) - change_at(row, row);
      const S duration_s = quantity<S>(port.time_s[row + 1] - port.time_s[row], dimension::kTime);
      const S grows = change_at(row, row) - change_at(row, row + 1);
      if (value_of(lacking) == 0.0 && value_of(grows) == 0.0) continue;
      const S steady = grows * time_constant_s / duration_s;
      const double bound_s = port.find_mean_start_s(row + 1);
      const std::array<double, 2> parts_s{bound_s - port.time_s[row], port.time_s[row + 1] - bound_s};
      for (std::size_t part = 0; part < parts_s.size(); ++part) {
        const S part_s = quantity<S>(parts_s[part], dimension::kTime);
        const S left_over = exp(-part_s / time_constant_s);
        integral[row + part] += (lacking - steady) * (time_constant_s * (S(1.0) - left_over)) + steady * part_s;
        lacking = (lacking - steady) * left_over + steady;
      }
    }
    for (std::size_t row = 0; row < integral.size(); ++row) {
      const double width_s = port.find_mean_start_s(row + 1) - port.find_mean_start_s(row);
      integral[row] = integral[row] / quantity<S>(width_s, dimension::kTime);
    }
    return integral;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    std::vector<S>* pressure_Pa = port.find(quantities::kCavityPressure);
    const std::vector<S>* load_N = port.find(quantities::kLoad);
    const std::vector<S>* speed_m_s = port.find(quantities::kSpeed);
    if (pressure_Pa == nullptr || load_N == nullptr || speed_m_s == nullptr || load_N->size() < 2) return;
    const std::vector<S> lacking = calc_lacking(self, port, *load_N, *speed_m_s);
    for (std::size_t row = 0; row < lacking.size(); ++row) {
      if (value_of(lacking[row]) == 0.0) continue;
      const S absolute_Pa = (*pressure_Pa)[row] + quantity<S>(kStandardAtmosphere_Pa, dimension::kPressure);
      (*pressure_Pa)[row] -= S(1.0 + kKappaLessOne) * lacking[row] * absolute_Pa;
    }
  }
};

const Effect& effect() { return make_effect<CavityVolume>(); }

}  // namespace rollrig::models::cavity_volume
