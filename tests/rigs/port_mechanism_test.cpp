// Every port does what it says, shown with effects made for the test.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/drum_fixture.h"

using namespace rollrig;
using models::EffectInfo;
using models::EffectView;
using models::Instant;
using models::Node;
using tests::DrumFixture;

namespace {

EffectInfo plain_info(const char* id, std::vector<models::EffectParameter> parameters) {
  EffectInfo info;
  info.id = id;
  info.parameters = std::move(parameters);
  return info;
}

const models::EffectParameter kSize{"size", any_number(), {0.0, 1.0}, "size", 0.0};

/// Input, boundary, gas and contact ports.
struct Surroundings {
  static EffectInfo info() { return plain_info("surroundings", {kSize}); }
  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, models::InputPort<S>& port) {
    port.speed_m_s *= S(1.0) + S(0.1) * self.parameter(0);
    port.acceleration_m_s2 *= S(1.0) + S(0.1) * self.parameter(0);
    port.load_N *= S(1.0) + S(0.2) * self.parameter(0);
  }
  template <class S>
  static void boundary(const EffectView<S>& self, const Instant<S>&, models::BoundaryPort<S>& port) {
    port.surface_K += quantity<S>(10.0, dimension::kTemperature) * self.parameter(0);
    port.air_speed_m_s *= S(1.0) - S(0.5) * self.parameter(0);
  }
  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>&, models::GasPort<S>& port) {
    port.mass_ratio *= S(1.0) - S(0.1) * self.parameter(0);
  }
  template <class S>
  static void contact(const EffectView<S>& self, const Instant<S>&, models::ContactPort<S>& port) {
    port.slip_compliance_per_N += quantity<S>(1.0 / 75000.0, Dimension{} / dimension::kForce) * self.parameter(0);
    port.machine_inertia_factor *= S(1.0) + S(0.5) * self.parameter(0);
  }
};

/// Loss, parasitic and thermal ports with further nodes, an own state and an initial state.
struct InsideTheTire {
  static EffectInfo info() {
    EffectInfo info = plain_info("inside", {kSize});
    info.states = {{"memory", 1.0, "fades"}};
    info.nodes = {false, false, true, true};
    return info;
  }
  template <class S>
  static void initial(const EffectView<S>&, const models::InitialPort<S>& port, S* states) {
    states[0] = port.soaked ? S(1.0) : S(0.5);
  }
  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, models::LossPort<S>& port) {
    port.factor *= S(1.0) + S(0.2) * self.parameter(0) * self.state(0);
    port.temperature_K = S(0.5) * (now.thermal.temperature_K[0] + now.thermal.temperature_K[2]);
    port.add_force(quantity<S>(2.0, dimension::kForce) * self.parameter(0), S(0.25));
  }
  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, models::ParasiticPort<S>& port) {
    port.extra_force_N += S(1e-4) * now.motion.load_N * self.parameter(0);
  }
  template <class S>
  static void thermal(const EffectView<S>&, const Instant<S>& now, models::ThermalPort<S>& port) {
    const std::size_t rubber = models::index_of(Node::kLiner);
    const std::size_t tread = models::index_of(Node::kTread);
    const std::size_t rim = models::index_of(Node::kRim);
    port.heat_capacity_J_per_K[tread] = S(0.5) * port.heat_capacity_J_per_K[rubber];
    port.heat_capacity_J_per_K[rubber] *= S(0.5);
    port.heat_W[tread] = S(0.5) * port.heat_W[rubber];
    port.heat_W[rubber] *= S(0.5);
    std::swap(port.air_W_per_K[tread], port.air_W_per_K[rubber]);
    std::swap(port.road_W_per_K[tread], port.road_W_per_K[rubber]);
    const Dimension conductance = dimension::kPower / dimension::kTemperature;
    port.link(Node::kTread, Node::kLiner) = quantity<S>(60.0, conductance);
    port.link(Node::kLiner, Node::kRim) = quantity<S>(2.0, conductance);
    port.heat_capacity_J_per_K[rim] = quantity<S>(7000.0, conductance * dimension::kTime);
    port.air_W_per_K[rim] =
        quantity<S>(3.0, conductance) + quantity<S>(0.1, conductance / dimension::kSpeed) * now.boundary.air_speed_m_s;
  }
  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>&, S* rates) {
    rates[0] = -self.state(0) / quantity<S>(300.0, dimension::kTime);
  }
};

/// Trace port.
/// A leak: gas port with an own state that filling sets back.
struct Leak {
  static EffectInfo info() {
    EffectInfo info = plain_info("leak", {kSize});
    info.states = {{"gas_lost", 1.0, "share of the gas"}};
    return info;
  }
  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>&, models::GasPort<S>& port) {
    port.mass_ratio *= S(1.0) - self.state(0);
  }
  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>&, S* state_rates) {
    state_rates[0] = self.parameter(0) / quantity<S>(1000.0, dimension::kTime);
  }
  template <class S>
  static void inflated(const EffectView<S>&, S* states) {
    states[0] = S(0.0);
  }
};

struct Logger {
  static EffectInfo info() { return plain_info("logger", {kSize}); }
  template <class S>
  static void trace(const EffectView<S>& self, models::TracePort<S>& port) {
    std::vector<S>* torque = port.find(models::quantities::kDrumTorque);
    for (std::size_t i = 0; torque != nullptr && i < torque->size(); ++i) {
      (*torque)[i] += self.parameter(0) * S(port.time_s[i]);
    }
  }
};

sim::Program short_test() {
  const double v = 20.0;
  sim::Program program;
  sim::Phase up = tests::rolling("up", 60.0, 0.0, 200.0);
  up.segments = {tests::drum_segment(60.0, 0.0, v, 200.0)};
  program.phases = {up, tests::rolling("load", 600.0, v, 5000.0), tests::rolling("skim", 60.0, v, 200.0)};
  return program;
}

template <class E>
DrumFixture with(double size) {
  static const models::Effect effect = models::make_effect<E>();
  DrumFixture fixture;
  fixture.effects = {tests::make_active(effect, {size})};
  return fixture;
}

}  // namespace

TEST_CASE("an effect's hooks are found where it has them, and nowhere else", "[fast]") {
  const models::Effect effect = models::make_effect<Logger>();
  CHECK(effect.hooks<double>().trace != nullptr);
  CHECK(effect.hooks<Jet>().trace != nullptr);
  CHECK(effect.hooks<DimensionedScalar>().trace != nullptr);
  CHECK(effect.hooks<double>().loss == nullptr);
  CHECK(effect.hooks<double>().rates == nullptr);
}

TEST_CASE("input, boundary, gas and contact ports act in both fidelities alike", "[fast]") {
  const DrumFixture fixture = with<Surroundings>(1.0);
  const auto multibody = fixture.run_multibody(short_test());
  const auto quasi_static = fixture.run_quasi_static(short_test());
  CHECK_NOTHROW(multibody.audit.require_closed(sim::kAuditLimit));
  CHECK_NOTHROW(quasi_static.audit.require_closed(sim::kAuditLimit));
  const std::size_t row = 600;
  for (const auto* recording : {&multibody, &quasi_static}) {
    CHECK(recording->channel("contact_load_N")[row] == Approx(6000.0).epsilon(1e-6));  // 5000 N recorded
    CHECK(recording->channel("load_N")[row] == 5000.0);
    CHECK(recording->channel("speed_km_h")[row] == 20.0);
  }
  CHECK(multibody.channel("drum_torque_Nm")[row] == Approx(quasi_static.channel("drum_torque_Nm")[row]).epsilon(1e-4));
  // more drum inertia shows in the run-up, where the speed that acts rises 10 % faster
  const auto plain = DrumFixture().run_quasi_static(short_test());
  const rigs::DrumParameters& drum = fixture.rig.drum;
  const double inertia_torque_Nm = drum.inertia_kg_m2 / (drum.diameter_m / 2.0) * (1.5 * 1.1 - 1.0) * 20.0 / 60.0;
  CHECK(quasi_static.channel("drum_torque_Nm")[30] - plain.channel("drum_torque_Nm")[30] ==
        Approx(inertia_torque_Nm).epsilon(0.05));
  // a tenth of the gas less: absolute pressure falls by a tenth
  CHECK(quasi_static.channel("cavity_pressure_kPa")[0] + 101325.0 == Approx(0.9 * (280e3 + 101325.0)).epsilon(1e-3));
}

TEST_CASE("loss, parasitic, thermal and initial ports act in both fidelities alike, further nodes included", "[fast]") {
  const DrumFixture fixture = with<InsideTheTire>(1.0);
  const auto multibody = fixture.run_multibody(short_test());
  const auto quasi_static = fixture.run_quasi_static(short_test());
  CHECK_NOTHROW(multibody.audit.require_closed(sim::kAuditLimit));
  CHECK_NOTHROW(quasi_static.audit.require_closed(sim::kAuditLimit));
  const std::size_t row = 600;
  CHECK(multibody.channel("drum_torque_Nm")[row] == Approx(quasi_static.channel("drum_torque_Nm")[row]).epsilon(1e-4));
  CHECK(quasi_static.channel("tread_temperature_degC")[row] > quasi_static.channel("rim_temperature_degC")[row]);
  CHECK(quasi_static.channel("inside.memory")[row] == Approx(std::exp(-600.0 / 300.0)).epsilon(1e-5));
  CHECK(quasi_static.channel("parasitic_N")[row] -
            DrumFixture().run_quasi_static(short_test()).channel("parasitic_N")[row] ==
        Approx(0.5).epsilon(1e-9));
}

TEST_CASE("a force that heats in part leaves the rest of its work out of the rubber", "[fast]") {
  const auto recording = with<InsideTheTire>(1.0).run_quasi_static(short_test());
  const double lost_J = -recording.audit.find_term_J("tire_loss");
  const double heat_J = recording.audit.find_term_J("heat_generated");
  // 2 N, of which a quarter heats: 1.5 N over the distance of the test. The run-up covers 600 m.
  const double distance_m = 600.0 + 20.0 * 660.0;
  CHECK(lost_J - heat_J == Approx(1.5 * distance_m).epsilon(1e-3));
}

TEST_CASE("a tire that leaks has the set pressure again once it is set", "[fast]") {
  const DrumFixture fixture = with<Leak>(0.1);
  sim::Program program;
  sim::Phase filled = tests::rolling("filled", 60.0, 0.0, 200.0);
  filled.commands = {{rigs::kSetPressure, 250e3}};
  program.phases = {tests::rolling("leaking", 600.0, 0.0, 200.0), filled};
  for (const auto& recording : {fixture.run_multibody(program), fixture.run_quasi_static(program)}) {
    const auto& pressure_Pa = recording.channel("cavity_pressure_kPa");
    CHECK(pressure_Pa[590] < 0.95 * pressure_Pa[1]);
    CHECK(pressure_Pa[602] == Approx(250e3).epsilon(1e-3));
  }
}

TEST_CASE("the trace port changes a channel after the run", "[fast]") {
  const auto with_logger = with<Logger>(0.01).run_quasi_static(short_test());
  const auto without = DrumFixture().run_quasi_static(short_test());
  CHECK(with_logger.channel("drum_torque_Nm")[500] - without.channel("drum_torque_Nm")[500] == Approx(5.0));
  CHECK(with_logger.channel("liner_temperature_degC") == without.channel("liner_temperature_degC"));
}
