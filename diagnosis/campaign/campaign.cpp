#include "diagnosis/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/campaign/test_information.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

/// The effects that count, each with the sizes at which it is judged.
class JudgedEffects {
 public:
  explicit JudgedEffects(const std::vector<const Term*>& terms) {
    for (const Term* term : terms) {
      for (const JudgedSize& size : list_judged_sizes(*term)) {
        effect_.push_back(terms_.size());
        sizes_.push_back(size);
        points_.push_back(list_size_points(size.term.term->parameters().front(), size.term.sign, size.u));
      }
      terms_.push_back(term);
    }
  }

  const std::vector<JudgedSize>& sizes() const { return sizes_; }
  const std::vector<const Term*>& terms() const { return terms_; }

  /// Of each effect, the index of the judged size that is hardest to see.
  std::vector<std::size_t> find_hardest(const Eigen::VectorXd& detectability) const {
    std::vector<std::size_t> hardest(terms_.size(), sizes_.size());
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      std::size_t& at = hardest[effect_[i]];
      if (at == sizes_.size() || detectability[to_index(i)] < detectability[to_index(at)]) at = i;
    }
    return hardest;
  }

  /// The share of an effect's prior that is visible where a judged size has that d'.
  double calc_share(std::size_t size, double detectability) const {
    if (!(detectability > 0.0)) return 0.0;
    const double least = thresholds::kDetectableEffect_sd / detectability;
    double seen = 0.0;
    for (const SizePoint& point : points_[size]) {
      if (std::abs(point.ratio) >= least) seen += point.weight;
    }
    return seen;
  }

 private:
  std::vector<const Term*> terms_;
  std::vector<JudgedSize> sizes_;
  std::vector<std::size_t> effect_;             // of each size
  std::vector<std::vector<SizePoint>> points_;  // likewise, of its prior
};

/// What some tests together are worth.
struct Worth {
  std::size_t visible = 0;
  double value = 0.0;

  bool operator<(const Worth& other) const {
    return visible != other.visible ? visible < other.visible : value < other.value;
  }
};

Worth calc_worth(const JudgedEffects& effects, const TestInformation& information) {
  constexpr double kNearer = 0.1;
  const Eigen::VectorXd detectability = information.calc_detectability();
  Worth worth;
  for (const std::size_t size : effects.find_hardest(detectability)) {
    const double d = detectability[to_index(size)];
    worth.value += effects.calc_share(size, d) + kNearer * std::min(1.0, d / thresholds::kDetectableEffect_sd);
    if (d >= thresholds::kDetectableEffect_sd) ++worth.visible;
  }
  return worth;
}

/// A test that could be in the campaign.
struct Possible {
  PlannedTest test;
  TestInformation information;
};

/// Indices of tests, in the order in which they were chosen.
using TestChoice = std::vector<std::size_t>;

/// Adds to `chosen` the tests with the largest gain of value per hour, one by one, while one fits and is worthwhile.
void fill(const JudgedEffects& effects, const std::vector<Possible>& all, double most_hours,
          const std::vector<std::size_t>& forbidden, TestInformation& known, TestChoice& chosen) {
  constexpr double kWorthwhile = 1e-3;  // Assumed: gain of value per hour
  constexpr double kSlack_h = 1e-9;
  double left_h = most_hours;
  for (const std::size_t i : chosen) left_h -= all[i].test.hours;
  const auto is_in = [](const std::vector<std::size_t>& some, std::size_t i) {
    return std::find(some.begin(), some.end(), i) != some.end();
  };
  while (true) {
    const double before = calc_worth(effects, known).value;
    std::size_t best = all.size();
    double best_rate = kWorthwhile;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double hours = all[i].test.hours;
      if (is_in(chosen, i) || is_in(forbidden, i) || hours > left_h + kSlack_h) continue;
      TestInformation with = known;
      const double rate = (calc_worth(effects, with += all[i].information).value - before) / hours;
      if (rate > best_rate) {
        best = i;
        best_rate = rate;
      }
    }
    if (best == all.size()) return;
    known += all[best].information;
    chosen.push_back(best);
    left_h -= all[best].test.hours;
  }
}

TestInformation sum_up(const std::vector<Possible>& all, const TestChoice& chosen, const TestInformation& none) {
  TestInformation sum = none;
  for (const std::size_t i : chosen) sum += all[i].information;
  return sum;
}

/// The greedy choice, improved by exchanging one or two of its tests as long as this helps.
TestChoice choose_tests(const JudgedEffects& effects, const std::vector<Possible>& all, double most_hours,
                        const TestInformation& none) {
  TestChoice best;
  TestInformation known = none;
  fill(effects, all, most_hours, {}, known, best);
  Worth worth = calc_worth(effects, known);
  for (bool is_better = true; is_better;) {
    is_better = false;
    const TestChoice from = best;
    for (std::size_t a = 0; a < from.size(); ++a) {
      for (std::size_t b = a; b < from.size(); ++b) {
        const std::vector<std::size_t> out{from[a], from[b]};
        TestChoice tried;
        for (const std::size_t i : from) {
          if (i != out[0] && i != out[1]) tried.push_back(i);
        }
        TestInformation with = sum_up(all, tried, none);
        fill(effects, all, most_hours, out, with, tried);
        const Worth now = calc_worth(effects, with);
        if (worth < now) {
          worth = now;
          best = tried;
          is_better = true;
        }
      }
    }
  }
  return best;
}

/// The same tests, ordered by the gain of value per hour after the tests before them.
TestChoice put_in_order(const JudgedEffects& effects, const std::vector<Possible>& all, const TestChoice& chosen,
                        const TestInformation& none) {
  TestChoice ordered;
  TestChoice left = chosen;
  TestInformation known = none;
  while (!left.empty()) {
    const auto rate = [&](std::size_t i) {
      TestInformation with = known;
      return calc_worth(effects, with += all[i].information).value / all[i].test.hours;
    };
    const double before = calc_worth(effects, known).value;
    const auto next = std::max_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
      return rate(a) - before / all[a].test.hours < rate(b) - before / all[b].test.hours;
    });
    known += all[*next].information;
    ordered.push_back(*next);
    left.erase(next);
  }
  return ordered;
}

/// The ordinary run with the sensors that the machine has.
std::optional<PlannedTest> make_ordinary_test(const PreparedSet& set) {
  std::optional<PlannedTest> test = set.kind().make_sensor_test(set);
  if (!test.has_value()) return std::nullopt;
  for (measurements::MeasuredRun& run : test->runs) {
    for (const Quantity& sensor : test->extra.sensors) run.columns.erase(sensor);
  }
  test->extra.sensors.clear();
  return test;
}

/// The ordinary run, then the menu without tests that no set could hold: their descriptions are put into `left_out`.
std::vector<PlannedTest> list_tests(const PreparedSet& set, std::vector<std::string>& left_out) {
  std::vector<PlannedTest> tests;
  if (std::optional<PlannedTest> ordinary = make_ordinary_test(set)) tests.push_back(*std::move(ordinary));
  for (PlannedTest& test : make_test_menu(set)) {
    if (is_held_by_sets(test, *set.source().kind)) {
      tests.push_back(std::move(test));
    } else {
      left_out.push_back(test.description);
    }
  }
  return tests;
}

EffectVisibility describe_visibility(const JudgedEffects& effects, std::size_t size, double detectability) {
  const JudgedSize& judged = effects.sizes()[size];
  const models::EffectParameter& declared = judged.term.term->parameters().front();
  const Unit unit = unit_of_key(declared.key);
  EffectVisibility visibility;
  visibility.effect = judged.term.term->name();
  visibility.detectability = detectability;
  visibility.is_visible = detectability >= thresholds::kDetectableEffect_sd;
  visibility.share_percent = 100.0 * effects.calc_share(size, detectability);
  visibility.size = declared.key;
  visibility.unit = unit.symbol;
  visibility.usual = from_prior_units(declared, judged.u, judged.term.sign).value_SI / unit.factor;
  const double off = declared.off.value_or(0.0);
  if (detectability > 0.0) {
    const double smallest = off + (visibility.usual - off) * thresholds::kDetectableEffect_sd / detectability;
    if (declared.range.contains(smallest)) visibility.smallest = smallest;  // else no size of the effect is visible
  }
  return visibility;
}

std::vector<std::string> list_visible(const JudgedEffects& effects, const TestInformation& known) {
  std::vector<std::string> visible;
  const Eigen::VectorXd detectability = known.calc_detectability();
  const std::vector<std::size_t> hardest = effects.find_hardest(detectability);
  for (std::size_t e = 0; e < hardest.size(); ++e) {
    if (detectability[to_index(hardest[e])] >= thresholds::kDetectableEffect_sd) {
      visible.push_back(effects.terms()[e]->name());
    }
  }
  return visible;
}

/// What each test makes visible, in order. Adds the information of all tests to `known`.
std::vector<CampaignTest> make_ledger(const JudgedEffects& effects, const std::vector<Possible>& all,
                                      const TestChoice& ordered, TestInformation& known) {
  std::vector<CampaignTest> ledger;
  std::vector<std::string> before = list_visible(effects, known);
  double hours = 0.0;
  for (const std::size_t i : ordered) {
    const PlannedTest& test = all[i].test;
    known += all[i].information;
    hours += test.hours;
    CampaignTest entry{test.id, test.description, test.hours, hours, test.soaked, test.by_hand, {}, {}, 0};
    for (const measurements::MeasuredRun& run : test.runs) entry.runs.push_back(run.id);
    std::vector<std::string> visible = list_visible(effects, known);
    for (const std::string& effect : visible) {
      if (std::find(before.begin(), before.end(), effect) == before.end()) entry.shows.push_back(effect);
    }
    entry.visible = visible.size();
    before = std::move(visible);
    ledger.push_back(std::move(entry));
  }
  return ledger;
}

/// Information of every test that can be simulated.
std::vector<Possible> judge_all(const Study& study, const std::vector<JudgedSize>& sizes,
                                std::vector<PlannedTest> tests, const CampaignInput& input) {
  std::vector<std::optional<TestInformation>> found(tests.size());
  const auto advance = [&](double share) {
    if (input.progress) input.progress(share, "tests");
  };
  parallel_for(
      tests.size(), input.threads, [&](std::size_t i) { found[i] = predict_information(study, sizes, tests[i]); },
      advance);
  std::vector<Possible> possible;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (found[i].has_value()) possible.push_back({std::move(tests[i]), *std::move(found[i])});
  }
  return possible;
}

}  // namespace

PlannedCampaign plan_campaign(const CampaignInput& input) {
  require_machine_hours(input.hours);
  require_valid_options({input.without, input.only});
  PlannedCampaign campaign;
  campaign.set = make_usual_set(input);
  campaign.most_hours = input.hours;
  const measurements::MeasurementSet& set = campaign.set;
  const JudgedEffects effects(choose_terms(set.kind->traits, set.tire.model(set.baseline), input.only, input.without));
  if (effects.terms().empty()) {
    throw InputError({"none of the effects that count can be seen on such a machine", "command line", 0, "--only",
                      fmt::format("{}", fmt::join(input.only, ",")), "effects that act there", ""});
  }
  const Study study(set);
  const std::vector<Possible> all = judge_all(study, effects.sizes(), list_tests(study.set, campaign.left_out), input);
  const TestInformation none = make_no_information(study, effects.sizes());
  const TestChoice ordered = put_in_order(effects, all, choose_tests(effects, all, input.hours, none), none);
  if (ordered.empty()) {
    double least_h = all.empty() ? 0.0 : all.front().test.hours;
    for (const Possible& one : all) least_h = std::min(least_h, one.test.hours);
    throw InputError({"no test of the machine fits into the hours", "command line", 0, "--hours",
                      fmt::format("{:g}", input.hours), fmt::format("{:.1f} or more", least_h + 0.05), ""});
  }
  TestInformation known = none;
  campaign.ledger = make_ledger(effects, all, ordered, known);
  for (const std::size_t i : ordered) campaign.tests.push_back(all[i].test);
  campaign.hours = campaign.ledger.back().hours_until_end;
  const Eigen::VectorXd detectability = known.calc_detectability();
  for (const std::size_t size : effects.find_hardest(detectability)) {
    campaign.effects.push_back(describe_visibility(effects, size, detectability[to_index(size)]));
  }
  std::stable_sort(campaign.effects.begin(), campaign.effects.end(),
                   [](const auto& a, const auto& b) { return a.detectability > b.detectability; });
  return campaign;
}

}  // namespace rollrig::diagnosis
