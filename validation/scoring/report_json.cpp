#include <cmath>

#include "diagnosis/output/diagnosis_json.h"
#include "validation/scoring/report.h"

namespace rollrig::validation {
namespace {

Json number(const std::optional<double>& value) {
  return value.has_value() && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

const char* name_of(Unit unit) {
  if (unit == Unit::kNumber) return "1";
  return unit == Unit::kPercent ? "share" : "s";
}

Json make_figure(const Figure& figure) {
  const auto& interval = figure.interval;
  return {{"id", figure.id},
          {"label", figure.label},
          {"value", number(figure.value)},
          {"low_95", interval ? number(interval->low) : Json(nullptr)},
          {"high_95", interval ? number(interval->high) : Json(nullptr)},
          {"k", interval ? Json(figure.k) : Json(nullptr)},
          {"n", figure.n},
          {"unit", name_of(figure.unit)},
          {"target", number(figure.target)},
          {"floor", number(figure.floor)},
          {"more_is_better", figure.more_is_better},
          {"best_baseline", number(figure.best_baseline)},
          {"best_baseline_id", figure.best_baseline_id.empty() ? Json(nullptr) : Json(figure.best_baseline_id)},
          {"ceiling", number(figure.upper_bound)},
          {"note", figure.note}};
}

Json make_tallies(const Tallies& tallies) {
  Json json = Json::object();
  for (const auto& [name, tally] : tallies) {
    json[name] = {{"sets", tally.cases},
                  {"named", tally.named},
                  {"other_cause", tally.named_wrong},
                  {"no_gap", tally.no_gap},
                  {"unexplained", tally.unexplained},
                  {"failed", tally.failed},
                  {"right_above", tally.right_above},
                  {"wrong_above", tally.wrong_above},
                  {"mean_named_set", tally.mean_named_set()}};
  }
  return json;
}

Json make_missed(const Case& one) {
  Json effects = Json::array();
  for (const TrueEffect& effect : one.truth.effects) {
    effects.push_back(
        {{"id", effect.id}, {"size", number(effect.size)}, {"unit", effect.unit}, {"size_class", effect.size_class}});
  }
  return {{"set", one.truth.number},      {"campaign", one.truth.campaign},           {"effects", effects},
          {"outside", one.truth.outside}, {"signal_floors", one.truth.signal_floors}, {"d_prime", number(one.d_prime)},
          {"said", one.said()},           {"answer", make_answer_json(one.answer)}};
}

Json make_reliability_group(const ReliabilityGroup& group) {
  const Interval right = calc_wilson_95(group.bin.right, group.bin.cases);
  return {
      {"kind", group.kind},       {"verdict", diagnosis::name_of(group.verdict)},           {"cases", group.bin.cases},
      {"right", group.bin.right}, {"mean_probability", number(group.bin.mean_probability)}, {"low_95", right.low},
      {"high_95", right.high}};
}

Json describe_share(std::size_t k, std::size_t n) {
  const Interval interval = calc_wilson_95(k, n);
  return {{"k", k}, {"n", n}, {"low_95", interval.low}, {"high_95", interval.high}};
}

Json describe_locations(const Score& score) {
  Json json = Json::object();
  for (const auto& [kind, tally] : score.locations) {
    json[kind] = {{"channel", describe_share(tally.channel, tally.answers)},
                  {"run", describe_share(tally.run, tally.answers)},
                  {"phase", describe_share(tally.phase, tally.answers)},
                  {"all_three", describe_share(tally.all_three, tally.answers)},
                  {"named", describe_share(tally.shifted, tally.named)}};
  }
  return json;
}

Json make_baselines(const Score& score) {
  Json json = Json::object();
  for (const BaselineScore& baseline : score.baselines) json[baseline.id] = baseline.values;
  return json;
}

}  // namespace

Json make_score_json(const Score& score) {
  Json figures = Json::array();
  for (const Figure& figure : score.figures) figures.push_back(make_figure(figure));
  Json reliability = Json::array();
  for (const ReliabilityBin& bin : score.reliability) {
    reliability.push_back(
        {{"cases", bin.cases}, {"right", bin.right}, {"mean_probability", number(bin.mean_probability)}});
  }
  Json confusion = Json::object();
  for (const auto& [truth, row] : score.confusion) confusion[truth] = row;
  Json missed = Json::array();
  for (const Case& one : score.missed) missed.push_back(make_missed(one));
  return {{"format", "rollrig-blind-score/1"},
          {"sets", score.cases},
          {"figures", figures},
          {"baselines", make_baselines(score)},
          {"by_effect", make_tallies(score.by_effect)},
          {"by_campaign", make_tallies(score.by_campaign)},
          {"by_size_class", make_tallies(score.by_size_class)},
          {"all_effects", make_tallies({{"all", score.all_effects}}).at("all")},
          {"confusion", confusion},
          {"reliability", reliability},
          {"reliability_by_kind", make_list(score.reliability_groups, make_reliability_group)},
          {"locations", describe_locations(score)},
          {"next_tests", make_follow_ups_json(score)},
          {"missed", missed},
          {"warnings", score.warnings}};
}

}  // namespace rollrig::validation
