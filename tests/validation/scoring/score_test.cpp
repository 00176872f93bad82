// A validation set whose answers are known, counted by hand.
#include "validation/scoring/score.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "tests/validation/scoring/hand_made_cases.h"
#include "validation/scoring/baselines/baselines.h"
#include "validation/scoring/report.h"

using namespace rollrig;
using namespace rollrig::tests;
using validation::Case;
using validation::Figure;

namespace {

const Figure& figure_of(const validation::Score& score, const std::string& id) {
  for (const Figure& figure : score.figures) {
    if (figure.id == id) return figure;
  }
  FAIL("no figure " << id);
  return score.figures.front();
}

void check_share(const validation::Score& score, const std::string& id, std::size_t k, std::size_t n) {
  INFO(id);
  const Figure& figure = figure_of(score, id);
  CHECK(figure.k == k);
  CHECK(figure.n == n);
  CHECK(figure.value.value() == Approx(static_cast<double>(k) / static_cast<double>(n)));
  CHECK(figure.interval.value().low == validation::calc_wilson_95(k, n).low);
}

Case outside(Case one) {
  one.truth.outside = true;
  return one;
}

std::vector<Case> make_set() {
  const Case single = make_case("0001", {"standing_wave"});
  std::vector<Case> root;
  root.push_back(say_size(say_cause(single, {"standing_wave"}, 0.97), "standing_wave.force_N", 2.2, 0.3));  // 10 % off
  root.push_back(say_cause(make_case("0002", {"rim_heat"}), {"slow_leak"}, 0.8, {"rim_heat"}));  // named, not exact
  root.push_back(say_cause(make_case("0003", {"rim_heat"}), {"windage"}, 0.95));                 // wrong, and sure
  root.push_back(say_no_gap(make_case("0004", {"slow_leak"})));                                  // not detected
  root.push_back(say_no_gap(make_case("0005", {"slow_leak"}, 0.2)));                             // cannot be detected
  root.push_back(say_unexplained(make_case("0006", {"slow_leak"})));                             // detected, not named
  root.push_back(say_cause(make_case("0007", {"windage", "rim_heat"}), {"rim_heat", "windage"}, 0.92));
  root.push_back(say_cause(make_case("0008", {"windage", "rim_heat"}), {"rim_heat"}, 0.6));  // one of two
  root.push_back(say_no_gap(make_case("0009", {})));
  root.push_back(say_cause(make_case("0010", {}), {"windage"}, 0.5));  // false alarm
  root.push_back(say_unexplained(outside(make_case("0011", {"drafting"}))));
  root.push_back(say_cause(outside(make_case("0012", {"drafting"})), {"windage"}, 0.99));
  return root;
}

}  // namespace

TEST_CASE("of three effects the score tells whether all are named, and whether what is named acts", "[fast]") {
  const std::vector<std::string> three{"windage", "rim_heat", "slow_leak"};
  std::vector<Case> cases{say_cause(make_case("0001", three), {"windage"}, 0.8),
                          say_cause(make_case("0002", three), {"torque_gain"}, 0.8),
                          say_cause(make_case("0003", three), three, 0.8), say_unexplained(make_case("0004", three))};
  for (Case& one : cases) {
    if (one.has_cause()) one.answer.diagnosis.causes.front().acts = 0.8;
  }
  const validation::Score score = validation::score_cases(cases, {});
  check_share(score, "triples", 1, 4);
  check_share(score, "triples_acting", 2, 3);
  CHECK(score.by_effect.at("triples").cases == 4);
}

TEST_CASE("the figures of a validation set are those counted by hand", "[fast]") {
  const validation::Score score = validation::score_cases(make_set(), {});
  check_share(score, "detection", 4, 5);
  check_share(score, "false_alarms", 1, 2);
  check_share(score, "top1_set_aware", 2, 5);
  check_share(score, "top1_strict", 2, 5);
  check_share(score, "refused", 1, 5);  // 0006
  check_share(score, "top1_exact", 1, 5);
  check_share(score, "pairs", 1, 2);
  check_share(score, "wrong_above_inside", 1, 8);
  check_share(score, "wrong_above_of_calls", 1, 3);  // 0001 and 0007 right, 0003 wrong
  check_share(score, "false_claims", 1, 4);          // 0001 and both of 0007 right, 0003 wrong
  check_share(score, "wrong_above_outside", 1, 2);
  check_share(score, "abstention", 1, 2);
  check_share(score, "size_coverage", 1, 1);
  CHECK(figure_of(score, "size_error").value.value() == Approx(0.1));
  CHECK(figure_of(score, "named_set").value.value() == Approx((1 + 2 + 1 + 2 + 1) / 5.0));
  CHECK(figure_of(score, "time_largest").value.value() == 4.0);
  CHECK_FALSE(figure_of(score, "shrinkage_median").value.has_value());
  CHECK(score.missed.size() == 6);  // all but 0001, 0002 (by its set), 0005 (nothing to see), 0007, 0009 and 0011
}

TEST_CASE("reliability by kind and verdict is counted by hand", "[fast]") {
  const auto on = [](const char* kind, Case one) {
    one.truth.kind = kind;
    return one;
  };
  Case failed = make_case("0006", {"rim_heat"});
  failed.answer.failure = "no fit converges";
  const std::vector<Case> cases{on("drum", say_cause(make_case("0001", {"rim_heat"}), {"rim_heat"}, 0.9)),
                                on("drum", say_cause(make_case("0002", {"rim_heat"}), {"windage"}, 0.8)),
                                on("drum", say_no_gap(make_case("0003", {}), 0.96)),
                                on("road", say_unexplained(make_case("0004", {"rim_heat"}), 0.7)),
                                on("road", say_cause(make_case("0005", {"slow_leak"}), {"slow_leak"}, 0.4)),
                                failed};
  const auto groups = validation::group_reliability(cases);
  const auto check = [&groups](std::size_t i, const std::string& kind, diagnosis::Verdict verdict, std::size_t right,
                               std::size_t of, double mean) {
    INFO(i);
    CHECK(groups.at(i).kind == kind);
    CHECK(groups[i].verdict == verdict);
    CHECK(groups[i].bin.right == right);
    CHECK(groups[i].bin.cases == of);
    CHECK(groups[i].bin.mean_probability == Approx(mean));
  };
  using diagnosis::Verdict;
  REQUIRE(groups.size() == 7);
  check(0, "drum", Verdict::kNoGap, 1, 1, 0.96);
  check(1, "drum", Verdict::kExplained, 1, 2, 0.85);
  check(2, "road", Verdict::kExplained, 1, 1, 0.4);
  check(3, "road", Verdict::kUnexplained, 0, 1, 0.7);
  check(4, "all", Verdict::kNoGap, 1, 1, 0.96);
  check(5, "all", Verdict::kExplained, 2, 3, 0.7);
  check(6, "all", Verdict::kUnexplained, 0, 1, 0.7);
  CHECK(validation::group_reliability({cases[0]}).size() == 1);  // one kind: nothing to put together
  const Json json = validation::make_score_json(validation::score_cases(cases, {})).at("reliability_by_kind");
  CHECK(json.at(1).at("verdict") == "explained");
  CHECK(json.at(1).at("mean_probability") == Approx(0.85));
  CHECK(json.at(1).at("low_95") == validation::calc_wilson_95(1, 2).low);
  // Wilson's interval of 0 of 1 is 0 to 79.3 %, of 1 of 1 20.7 to 100 %, which hold 70 and 40 %; that of 0 of 6 ends at
  // 39.0 %
  const std::vector<Case> sure(6, say_cause(make_case("0001", {"rim_heat"}), {"windage"}, 0.5));
  CHECK_THAT(validation::format_score_markdown(validation::score_cases(sure, {})),
             Catch::Contains("| drum | explained | 6 | 50.0 % | 0.0 % | 0.0 to 39.0 | too sure |"));
  CHECK_THAT(validation::format_score_markdown(validation::score_cases({cases[3]}, {})),
             Catch::Contains("| road | unexplained | 1 | 70.0 % | 0.0 % | 0.0 to 79.3 |  |"));
}

TEST_CASE("one of two causes, named alone, is told from another cause", "[fast]") {
  const Case pair = make_case("0001", {"windage", "rim_heat"});
  Case seen = say_cause(pair, {"rim_heat"}, 0.95);
  Case told = say_cause(pair, {"rim_heat", "windage"}, 0.95);
  const Case other = say_cause(pair, {"slow_leak"}, 0.95);
  const Case single = say_cause(make_case("0004", {"rim_heat"}), {"windage"}, 0.95);
  const validation::Score score = validation::score_cases({seen, told, other, single}, {});
  check_share(score, "wrong_above_inside", 3, 4);
  check_share(score, "wrong_above_half", 1, 4);
  CHECK_FALSE(figure_of(score, "pairs_identifiable").value.has_value());  // no bound was computed
  seen.d_prime = told.d_prime = 20.0;
  seen.identifiable = false;  // the second effect cannot be seen beside the first
  told.identifiable = true;
  check_share(validation::score_cases({seen, told, other, single}, {}), "pairs_identifiable", 1, 1);
}

TEST_CASE("a companion that is not there counts against a named cause, and so does its claim", "[fast]") {
  const Case one = make_case("0001", {"rim_heat"});
  const Case with_companion = say_cause(one, {"rim_heat", "windage"}, 0.95);
  CHECK(with_companion.is_named());
  CHECK_FALSE(with_companion.is_named_strictly());
  CHECK(with_companion.false_claims_above(0.9) == std::vector<std::string>{"windage"});
  CHECK(with_companion.false_claims_above(0.96).empty());
  CHECK(say_cause(one, {"rim_heat"}, 0.9, {"windage"}).is_named_strictly());  // it is said that it cannot be told
  CHECK(say_unexplained(with_companion).claims_above(0.9).empty());
  const validation::Score score = validation::score_cases({with_companion, say_cause(one, {"rim_heat"}, 0.95)}, {});
  check_share(score, "top1_set_aware", 2, 2);
  check_share(score, "top1_strict", 1, 2);
  check_share(score, "false_claims", 1, 3);
}

TEST_CASE("the probability that a cause acts is right where all of its effects act, alone or not", "[fast]") {
  const Case pair = make_case("0001", {"rim_heat", "windage"});
  Case one_of_two = say_cause(pair, {"rim_heat"}, 0.9);
  Case with_another = say_cause(pair, {"rim_heat", "slow_leak"}, 0.9);
  CHECK_FALSE(one_of_two.stated_acts().has_value());
  one_of_two.answer.diagnosis.causes.front().acts = 0.95;
  with_another.answer.diagnosis.causes.front().acts = 0.75;
  CHECK(one_of_two.stated_acts()->right);
  CHECK_FALSE(with_another.stated_acts()->right);
  const validation::Score score = validation::score_cases({one_of_two, with_another}, {});
  CHECK(figure_of(score, "ece_acts").value.value() == Approx(0.5 * 0.05 + 0.5 * 0.75));
}

TEST_CASE("the probability of acting alone is right where the first cause is the truth and no more", "[fast]") {
  Case single = say_cause(make_case("0001", {"rim_heat"}), {"rim_heat"}, 0.95);
  Case pair = say_cause(make_case("0002", {"rim_heat", "windage"}), {"rim_heat"}, 0.95);
  CHECK_FALSE(single.stated_alone().has_value());
  CHECK_FALSE(figure_of(validation::score_cases({single, pair}, {}), "ece_alone").value.has_value());
  single.answer.diagnosis.causes.front().alone = 0.85;
  pair.answer.diagnosis.causes.front().alone = 0.85;
  CHECK(single.stated_alone()->right);
  CHECK_FALSE(pair.stated_alone()->right);
  CHECK(figure_of(validation::score_cases({single, pair}, {}), "ece_alone").value.value() == Approx(0.35));
}

TEST_CASE("half of a pair is wrong where it is said to be all that acts, not where only that it acts is sure",
          "[fast]") {
  Case half = say_cause(make_case("0001", {"rim_heat", "windage"}), {"rim_heat"}, 0.98);
  CHECK(half.is_wrong_above(0.9));  // of a program that did not say more
  diagnosis::Cause& cause = half.answer.diagnosis.causes.front();
  cause.acts = 0.97;
  cause.complete = 0.93;
  CHECK(half.is_wrong_above(0.9));
  CHECK(half.stated().probability == 0.93);
  cause.complete = 0.8;
  CHECK_FALSE(half.is_wrong_above(0.9));
  CHECK_FALSE(half.is_right_above(0.9));
  CHECK(half.stated().probability == 0.8);
}

TEST_CASE("a cause that does not act is wrong however little is said of being alone", "[fast]") {
  Case other = say_cause(make_case("0001", {"rim_heat"}), {"windage"}, 0.95, {"slow_leak"});
  other.answer.diagnosis.causes.front().complete = 0.5;
  CHECK(other.is_wrong_above(0.9));
  Case companion = say_cause(make_case("0002", {"rim_heat"}), {"rim_heat", "windage"}, 0.95);
  companion.answer.diagnosis.causes.front().complete = 0.8;
  CHECK_FALSE(companion.is_wrong_above(0.9));
  companion.answer.diagnosis.causes.front().acts = 0.93;
  CHECK(companion.is_wrong_above(0.9));
}

TEST_CASE("top-3 counts who is as likely as the truth against it", "[fast]") {
  Case one = say_cause(make_case("0001", {"rim_heat"}), {"windage"}, 0.5);
  auto& probability = one.answer.diagnosis.probability;
  probability["rim_heat"] = 0.1;
  probability["slow_leak"] = 0.2;
  CHECK(one.rank_of_truth() == 2);
  check_share(validation::score_cases({one}, {}), "top3", 1, 1);
  probability["clock_shift"] = 0.1;
  CHECK(one.rank_of_truth() == 3);
  check_share(validation::score_cases({one}, {}), "top3", 0, 1);
  probability["rim_heat"] = 0.0;  // no share of what nobody gives a chance
  probability["load_exponent"] = 0.0;
  CHECK(one.rank_of_truth() == 4);
}

TEST_CASE("a named set of more than three names nothing", "[fast]") {
  const Case one = make_case("0001", {"rim_heat"});
  CHECK(say_cause(one, {"rim_heat"}, 0.9, {"windage", "slow_leak"}).is_named());
  CHECK_FALSE(say_cause(one, {"rim_heat"}, 0.9, {"windage", "slow_leak", "clock_shift"}).is_named());
}

TEST_CASE("a d' that is known decides what is detectable, and a baseline stands beside its figure", "[fast]") {
  std::vector<Case> root = make_set();
  for (Case& one : root) one.d_prime = 1.0;
  root[0].d_prime = 5.0;
  validation::Score score = validation::score_cases(root, {});
  validation::put_beside({{"aic", "AIC", {{"top1_set_aware", 0.62}, {"false_alarms", 0.3}}},
                          {"bic", "BIC", {{"top1_set_aware", 0.71}, {"false_alarms", 0.1}}},
                          {"gp", "process", {}}},
                         score);
  check_share(score, "top1_set_aware", 1, 1);
  CHECK(figure_of(score, "top1_set_aware").best_baseline.value() == 0.71);
  CHECK(figure_of(score, "false_alarms").best_baseline.value() == 0.1);  // the less the better
  CHECK(figure_of(score, "false_alarms").best_baseline_id == "bic");
  CHECK(validation::make_score_json(score)["baselines"]["aic"]["top1_set_aware"] == 0.62);
  CHECK(validation::format_score_markdown(score).find("71 (bic)") != std::string::npos);
  CHECK_FALSE(figure_of(score, "top3").best_baseline.has_value());
}

TEST_CASE("shrinkage is measured by that of the truth alone", "[fast]") {
  std::vector<Case> root = make_set();
  root[0].known_cause_shrink_percent = 80.0;
  root[0].answer.diagnosis.gap.shrink_percent = 60.0;
  root[3].known_cause_shrink_percent = 50.0;   // no gap: nothing shrinks
  root[4].known_cause_shrink_percent = -10.0;  // the truth itself does not help: not counted
  const validation::Score score = validation::score_cases(root, {});
  CHECK(figure_of(score, "shrinkage_median").n == 2);
  CHECK(figure_of(score, "shrinkage_median").value.value() == Approx(0.5 * (0.75 + 0.0)));
}

TEST_CASE("sizes are compared from where an effect does nothing", "[fast]") {
  Case one = say_cause(make_case("0001", {"pressure_exponent"}), {"pressure_exponent"}, 0.9);
  one.truth.effects.front() = {"pressure_exponent", 0.3, 0.4, "1", ""};
  one = say_size(one, "pressure_exponent.exponent_shift", -0.12, 0.01);  // 0.28 for 0.3, which is 0.1 from 0.4
  const auto check = one.check_size().value();
  CHECK(check.error == Approx(0.2));
  CHECK_FALSE(check.covered);
  Case stiff = say_cause(make_case("0002", {"slip_loss"}), {"slip_loss"}, 0.9);
  stiff.truth.effects.front() = {"slip_loss", 100.0, std::numeric_limits<double>::infinity(), "kN", ""};
  stiff = say_size(stiff, "slip_loss.compliance_per_kN", 0.008, 0.003);  // 125 kN, 91 to 200
  CHECK(stiff.check_size().value().error == Approx(0.25));
  CHECK(stiff.check_size().value().covered);
  const Case other_meaning = say_cause(make_case("0003", {"tread_liner_lag"}), {"tread_liner_lag"}, 0.9);
  CHECK_FALSE(other_meaning.check_size().has_value());
}

TEST_CASE("a diagnosis that failed is missed, and never right", "[fast]") {
  std::vector<Case> root{make_case("0001", {"rim_heat"}), make_case("0002", {}),
                         outside(make_case("0003", {"drafting"}))};
  for (Case& one : root) one.answer.failure = "no fit converges";
  const validation::Score score = validation::score_cases(root, {});
  CHECK(score.missed.size() == 3);
  check_share(score, "false_alarms", 1, 1);
  check_share(score, "abstention", 0, 1);
  check_share(score, "detection", 0, 1);
  check_share(score, "top3", 0, 1);
  CHECK(score.by_effect.at("rim_heat").failed == 1);
}

TEST_CASE("the report fits the terminal and says each missed set", "[fast]") {
  std::vector<Case> root = make_set();
  for (Case& one : root) {  // with all that an ideal observer can be asked
    one.d_prime = 20.0;
    one.identifiable = true;
    one.log_bayes_factors = {40.0, 50.0};
  }
  const validation::Score score = validation::score_cases(root, {});
  const std::string text = validation::format_score(score);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) CHECK(line.size() <= 80);
  const std::string page = validation::format_score_markdown(score);
  for (const Case& one : score.missed) {
    CHECK_THAT(text, Catch::Contains(one.truth.number + " "));
    CHECK_THAT(page, Catch::Contains("| " + one.truth.number + " "));
  }
  CHECK_THAT(page, Catch::Contains("| ideal observer |"));
  const Json json = validation::make_score_json(score);
  CHECK(json.at("figures").at(0).at("ceiling") == Approx(1.0));
  CHECK(json.at("figures").at(1).at("ceiling").is_null());  // false alarms: as many as one likes
  CHECK(json.at("missed").size() == score.missed.size());
  CHECK(json.at("confusion").at("rim_heat").at("windage") == 1);
  CHECK(json.at("by_effect").at("slow_leak").at("sets") == 3);
}

TEST_CASE("no gap is right where nothing can be seen, and where its trace is what acts", "[fast]") {
  const Case hidden = say_no_gap(make_case("0001", {"slow_leak"}, 0.2), 0.6);
  CHECK(hidden.is_right());
  CHECK(hidden.stated().probability == 0.6);
  Case stated = hidden;
  stated.answer.diagnosis.nothing_detectable = 0.97;  // beside a probability of none of 60 %
  CHECK(stated.stated().probability == 0.97);
  const Case missed = say_no_gap(make_case("0002", {"slow_leak"}, 3.0));
  CHECK_FALSE(missed.is_right());
  Case seen_by_observer = hidden;
  seen_by_observer.d_prime = 7.0;
  CHECK_FALSE(seen_by_observer.is_right());
  Case trace = missed;
  trace.answer.diagnosis.trace = diagnosis::Cause{};
  trace.answer.diagnosis.trace->effects = {"windage"};
  CHECK_FALSE(trace.is_right());
  trace.answer.diagnosis.trace->effects = {"slow_leak"};
  CHECK(trace.is_right());
  CHECK(trace.is_named_strictly());
  trace.answer.diagnosis.trace->effects = {"slow_leak", "windage"};
  CHECK(trace.is_named());
  CHECK_FALSE(trace.is_named_strictly());
}
