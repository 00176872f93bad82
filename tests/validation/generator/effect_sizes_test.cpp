// Sizes and base parameters of the independent generator are drawn as the catalog and the files say; each effect has
// two functional forms, in which its size means the same.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/run_program.h"
#include "tests/validation/generator/generated_set.h"
#include "validation/generator/options.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

using Ranges = std::map<std::string, std::pair<double, double>>;  // as the sources of the effects state them

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

/// Sizes and base parameters of a validation set: how many sizes are in the catalog's range, how the base scatters.
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

/// Truths of a validation set with so many cases of each effect and no others; on a dyno, of four that the others of
/// these tests do not show.
std::vector<Json> draw_truths(const std::string& kind, int each, std::uint64_t seed) {
  generator::ValidationSetOrder order;
  order.seed = seed;
  order.kind = kind;
  order.campaigns = generator::read_campaigns(kind);
  order.effects = kind == "dyno"
                      ? std::vector<std::string>{"slip_loss", "brake_heat", "tie_down_load", "curvature_exponent"}
                      : generator::drawn_effects(order.campaigns);
  order.each = each;
  order.singles = order.pairs = order.none = order.outside = 0;
  order.runs = 1;
  std::vector<Json> truths;
  for (const generator::SetOrder& one : generator::draw_cases(order)) truths.push_back(generator::draw_truth(one));
  return truths;
}

/// Where the size of an effect on a drum is said to hold.
struct Reference {
  const char* effect;
  const char* size;
  const char* channel;
  double speed_km_h;  // 0: any
  double apart;       // how far the forms may be from each other there, relative
  bool starting;      // in the first minutes, before tires that are heated otherwise differ
};

const std::vector<Reference> kReferences{
    {"windage", "2", "drum_torque_Nm", 80.0, 0.01, false},
    {"load_cross_talk", "0.3", "drum_torque_Nm", 0.0, 1e-6, false},
    {"bearing_load_friction", "2", "drum_torque_Nm", 80.0, 0.005, false},
    {"toe_camber_drag", "6", "drum_torque_Nm", 0.0, 0.02, true},
    {"standing_wave", "3", "drum_torque_Nm", 120.0, 0.02, false},
    {"speed_record", "4", "drum_torque_Nm", 80.0, 0.02, false},
    {"load_record", "4", "drum_torque_Nm", 80.0, 0.01, false},
    {"pressure_record", "8", "cavity_pressure_kPa", 80.0, 0.06, false},
    {"torque_gain", "2", "drum_torque_Nm", 0.0, 0.03, false},
    {"rubber_memory", "5", "drum_torque_Nm", 0.0, 0.05, true},
    {"flat_spot", "5", "drum_torque_Nm", 0.0, 0.05, true},
};

/// Mean change of a channel over rows at the reference load and speed; of soaked runs alone where `starting`.
double mean_change(const GeneratedSet& made, const Reference& at) {
  constexpr std::size_t kSettled = 30;
  constexpr std::size_t kFirst = 90;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
    const measurements::MeasuredRun& run = made.set.runs[r];
    if (at.starting && run.rest_before_s.has_value()) continue;
    const std::vector<double> change = find_difference(made, r, at.channel);
    const auto& v = run.columns.at("speed_km_h");
    const auto& load_N = run.columns.at("load_N");
    const std::size_t rows = at.starting ? kFirst : change.size();
    for (std::size_t row = kSettled; row < rows; ++row) {
      const bool loaded = std::abs(load_N[row] - 5400.0) < 1.0 && load_N[row - kSettled] == load_N[row];
      const bool fast = at.speed_km_h == 0.0 || std::abs(3.6 * v[row] - at.speed_km_h) < 0.1;
      if (!loaded || !fast || std::isnan(change[row])) continue;
      sum += change[row];
      count += 1.0;
    }
  }
  INFO(at.effect);
  REQUIRE(count > 0.0);
  return sum / count;
}

/// How often each form was drawn, by effect.
using Counts = std::map<std::string, std::map<std::string, int>>;

void count_forms(const std::string& kind, Counts& counts) {
  for (const Json& set : draw_truths(kind, 12, 51)) {
    const Json& effect = set.at("effects").at(0);
    ++counts[effect.at("id").get<std::string>()][effect.at("form").get<std::string>()];
  }
}

}  // namespace

TEST_CASE("sizes lie mostly but not always in the catalog's ranges, base parameters scatter as stated", "[slow]") {
  constexpr int kEach = 60;
  Drawn drawn;
  int inside = 0;
  int all = 0;
  for (const char* kind : {"drum", "road", "dyno"}) {
    std::map<std::string, int> before = drawn.inside;
    for (const Json& set : draw_truths(kind, kEach, 77)) drawn.add(set);
    for (auto& [id, count] : drawn.inside) {
      INFO(kind << ", " << id << ": " << count - before[id] << " of " << kEach);
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

TEST_CASE("each effect of the catalog has two forms, and seeds draw both about as often", "[slow]") {
  Counts counts;
  for (const char* kind : {"drum", "dyno", "road"}) count_forms(kind, counts);
  CHECK(counts.size() == 34);
  const auto forms = list_forms();
  int first = 0;
  int all = 0;
  for (const auto& [effect, of] : counts) {
    INFO(effect);
    REQUIRE(forms.at(effect).size() == 2);
    CHECK(of.size() == 2);
    for (const auto& [form, count] : of) {
      first += form == forms.at(effect).front() ? count : 0;
      all += count;
    }
  }
  INFO(first << " of " << all);
  CHECK(std::abs(first - 0.5 * all) < 2.0 * std::sqrt(all));  // four standard deviations
}

TEST_CASE("where its size is said to hold, an effect is the same in both forms", "[slow]") {
  constexpr int kSeed = 22;  // its campaign runs at the reference load
  const auto forms = list_forms();
  for (const Reference& at : kReferences) {
    std::vector<double> changes;
    for (const std::string& form : forms.at(at.effect)) {
      changes.push_back(mean_change(make_effect_set(with_form("drum", form), at.effect, at.size, kSeed), at));
    }
    INFO(at.effect << ": " << changes[0] << " and " << changes[1]);
    CHECK(std::abs(changes[1] / changes[0] - 1.0) <= at.apart);
  }
}

TEST_CASE("a form changes neither the size that is drawn nor noise, campaign and tire", "[slow]") {
  const std::string order = "--effect windage --seed 8 --form ";
  const GeneratedSet one = make_generated_set(order + "disc_and_pump");
  const GeneratedSet other = make_generated_set(order + "power");
  CHECK(one.truth.at("effects")[0].at("size") == other.truth.at("effects")[0].at("size"));
  CHECK(one.truth.at("effects")[0].at("law") != other.truth.at("effects")[0].at("law"));
  CHECK(one.truth.at("base") == other.truth.at("base"));
  for (std::size_t r = 0; r < one.set.runs.size(); ++r) {
    for (const auto& [quantity, column] : one.set.runs[r].columns) {
      if (quantity == models::quantities::kDrumTorque) continue;
      INFO(quantity.header());
      const auto& same = other.set.runs[r].column(quantity);
      const bool equal = std::equal(column.begin(), column.end(), same.begin(), same.end(),
                                    [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
      CHECK(equal);
    }
  }
}

TEST_CASE("a form that an effect does not have is refused, with those that it has", "[fast]") {
  const auto refused = run_validation("make-case --effect slow_leak --form nozle --out nowhere");
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("nozzle") && Catch::Contains("permeation"));
  CHECK(run_validation("make-case --effect slow_leak,windage --form nozzle --out nowhere").status == 2);
  CHECK(run_validation("make-case --effect none --form nozzle --out nowhere").status == 2);
}
