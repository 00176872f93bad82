// Heat flows of a page: those of the run, stretch by stretch.
#include "report/heat_course.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "report/run_page.h"
#include "scenarios/run/run_spec.h"

using namespace rollrig;

namespace {

scenarios::RunSpec make_heat_spec(const std::string& scenario, const std::string& tire,
                                  const std::vector<std::string>& settings) {
  ConfigTable document = scenarios::make_run_document(scenario);
  document.entries["tire"] = ConfigValue{tire, {"test", 0}, tire};
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  return scenarios::read_run_spec(document, "");
}

/// Energy of a flow over the whole run.
double sum_J(const report::HeatCourse& course, const std::vector<double>& mean_W) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mean_W.size(); ++i) sum += mean_W[i] * (course.time_s[i + 1] - course.time_s[i]);
  return sum;
}

/// A sample's mean stands for the instant in its middle: where the load jumps within a second, some hundred W are taken
/// for half a second too long.
constexpr double kJump_J = 300.0;
constexpr double kShare = 3e-3;

}  // namespace

TEST_CASE("heat flows add up to the energies of the run and to the change of stored heat", "[fast]") {
  for (const char* tire : {"a50", "a40"}) {
    INFO(tire);
    const scenarios::RunSpec spec = make_heat_spec("warm_up", tire, {"warm_up_min=20"});
    const sim::Recording<double> recording = scenarios::run_scenario(spec, {}).recording;
    const auto course = report::find_heat_course(spec, recording, "", 0, 50);
    REQUIRE(course.has_value());
    CHECK(course->generated_W.size() <= 50);
    CHECK(course->time_s.back() == recording.time_s.back());
    const auto check = [&](const std::vector<double>& flow_W, const char* term) {
      INFO(term);
      const double audit_J = std::abs(recording.audit.find_term_J(term));
      CHECK(sum_J(*course, flow_W) == Approx(audit_J).epsilon(kShare).margin(kJump_J));
    };
    check(course->generated_W, "heat_generated");
    check(course->to_air_W, "heat_to_air");
    check(course->to_surface_W, "heat_to_road");
    for (std::size_t i = 0; i < course->generated_W.size(); ++i) {
      INFO("stretch " << i << " from " << course->time_s[i] << " s");
      const double length_s = course->time_s[i + 1] - course->time_s[i];
      const double in_J = length_s * (course->generated_W[i] - course->to_air_W[i] - course->to_surface_W[i]);
      CHECK(in_J == Approx(course->stored_J[i + 1] - course->stored_J[i])
                        .epsilon(kShare)
                        .margin(kShare * length_s * course->generated_W[i] + kJump_J));
    }
  }
}

TEST_CASE("heat goes from tread to carcass to gas while a tire warms up", "[fast]") {
  const scenarios::RunSpec spec = make_heat_spec("warm_up", "a50", {"warm_up_min=20"});
  const auto course = report::find_heat_course(spec, scenarios::run_scenario(spec, {}).recording, "", 0, 50);
  REQUIRE(course.has_value());
  REQUIRE(course->nodes.size() == 3);
  const auto to_gas = std::find_if(course->links.begin(), course->links.end(),
                                   [](const report::HeatLink& link) { return link.to == models::Node::kGas; });
  REQUIRE(to_gas != course->links.end());
  CHECK(to_gas->from == models::Node::kLiner);
  // All that the gas takes up comes through the liner: its heat capacity times its warming.
  const auto gas = std::find_if(course->nodes.begin(), course->nodes.end(),
                                [](const report::HeatNode& node) { return node.node == models::Node::kGas; });
  const double warmed_J =
      spec.tire.values.thermal.gas_heat_capacity_J_per_K * (gas->temperature_K.back() - gas->temperature_K.front());
  CHECK(sum_J(*course, to_gas->mean_W) == Approx(warmed_J).epsilon(0.02));
}

TEST_CASE("a page's cross-section has the flows of drum, rollers and road", "[slow]") {
  const std::pair<const char*, const char*> runs[] = {
      {"warm_up", "drum"}, {"sae_j1634", "roller"}, {"coastdown", "road"}};
  for (const auto& [scenario, surface] : runs) {
    INFO(scenario);
    scenarios::RunSpec spec = make_heat_spec(scenario, "a50", {});
    spec.fidelity = scenarios::Fidelity::kQuasiStatic;
    const auto block = report::make_cross_section(spec, scenarios::run_scenario(spec, {}).recording);
    REQUIRE(block.has_value());
    CHECK((*block)["surface"] == surface);
    CHECK((*block)["t"].size() == (*block)["generated_W"].size() + 1);
    CHECK((*block)["nodes"].size() == 3);
    CHECK((*block).dump().size() < 60000);  // of a page of two megabytes
  }
}
