// Sizes and base parameters of the foreign generator are drawn as the catalogue and the files say.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/blind/blind_fixture.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

using Ranges = std::map<std::string, std::pair<double, double>>;  // of effects.md

const Ranges kRanges{{"bearing_warmup", {0.005, 0.04}},
                     {"tire_loss_in_skim", {0.3, 3.0}},
                     {"bearing_load_friction", {0.3, 3.0}},
                     {"torque_zero_drift", {0.0, 0.5}},
                     {"load_exponent", {0.85, 1.15}},
                     {"pressure_exponent", {0.25, 0.55}},
                     {"tread_liner_lag", {30.0, 150.0}},
                     {"rim_heat", {0.5, 4.0}},
                     {"slow_leak", {0.2, 2.0}},
                     {"standing_wave", {0.5, 4.0}},
                     {"rubber_memory", {1.0, 8.0}},
                     {"clock_shift", {0.5, 10.0}},
                     {"windage", {0.3, 3.0}},
                     {"torque_gain", {0.0, 2.0}},
                     {"toe_camber_drag", {2.0, 12.0}},
                     {"flat_spot", {1.0, 8.0}},
                     {"slip_loss", {60.0, 250.0}},
                     {"brake_heat", {2.0, 15.0}},
                     {"cell_air_warming", {1.0, 6.0}},
                     {"surface_warming", {2.0, 15.0}},
                     {"convection_law", {0.6, 1.0}},
                     {"curvature_exponent", {0.6, 1.4}},
                     {"brake_drag", {2.0, 12.0}},
                     {"tie_down_load", {50.0, 400.0}},
                     {"driveline_warming", {3.0, 25.0}},
                     {"inertia_error", {0.3, 4.0}},
                     {"wind_and_grade", {0.0, 5.0}},
                     {"tire_temperature", {0.008, 0.03}},
                     {"speed_record", {1.0, 10.0}},
                     {"load_record", {1.0, 5.0}},
                     {"pressure_record", {2.0, 15.0}}};

/// Sizes and base parameters of a bank: how many sizes are in the catalogue's range, how the base scatters.
struct Drawn {
  std::map<std::string, int> inside;
  std::map<std::string, double> squares;
  std::map<std::string, double> sums;
  std::map<std::string, double> counts;

  void add(const Json& set) {
    const Json& effect = set.at("effects")[0];
    const std::string id = effect.at("id").get<std::string>();
    const auto range = kRanges.find(id);
    if (range != kRanges.end()) {
      const double size = effect.at("size").get<double>();
      const double value = size < 0.0 ? -size : size;
      inside[id] += value >= range->second.first && value <= range->second.second ? 1 : 0;
    }
    for (const auto& [key, base] : set.at("base").items()) {
      const double z = (base.at("true").get<double>() - base.at("nominal").get<double>()) / base.at("sd").get<double>();
      squares[key] += z * z;
      sums[key] += z;
      counts[key] += 1.0;
    }
  }
};

Json make_bank_truth(const std::string& arguments) {
  const TemporaryFolder folder;
  REQUIRE(run_blind("bank " + arguments + " --runs 1 --none 0 --out " + folder.file("bank")).status == 0);
  return Json::parse(read_file(folder.file("bank/truth.json")));
}

}  // namespace

TEST_CASE("sizes lie mostly but not always in the catalogue's ranges, base parameters scatter as stated", "[slow]") {
  constexpr int kEach = 60;
  Drawn drawn;
  int inside = 0;
  int all = 0;
  for (const char* bank :
       {"--kind drum", "--kind road", "--kind dyno --effects slip_loss,brake_heat,tie_down_load,curvature_exponent"}) {
    const Json truth = make_bank_truth(fmt::format("{} --seed 77 --each {}", bank, kEach));
    std::map<std::string, int> before = drawn.inside;
    for (const auto& [number, set] : truth.at("sets").items()) drawn.add(set);
    for (auto& [id, count] : drawn.inside) {
      INFO(bank << ", " << id << ": " << count - before[id] << " of " << kEach);
      if (count == before[id]) continue;
      // Two thirds before sizes far out are drawn again, so two thirds at least: less more than three standard errors.
      CHECK(count - before[id] > 0.45 * kEach);
      CHECK(count - before[id] < kEach);
      inside += count - before[id];
      all += kEach;
    }
  }
  INFO(inside << " of " << all << " inside");
  CHECK(inside > 0.67 * all);
  CHECK(inside < 0.90 * all);
  CHECK(drawn.inside.size() == kRanges.size());
  for (const auto& [key, sum] : drawn.sums) {
    INFO(key);
    CHECK(std::abs(sum / drawn.counts[key]) < 4.0 / std::sqrt(drawn.counts[key]));
    CHECK(drawn.squares[key] / drawn.counts[key] == Approx(1.0).margin(4.0 * std::sqrt(2.0 / drawn.counts[key])));
  }
}
