#include "diagnosis/findings/verdict.h"

#include <catch2/catch.hpp>

TEST_CASE("no gap where none is likelier than the cause, or than each effect of one that names too many", "[fast]") {
  using rollrig::diagnosis::Cause;
  using rollrig::diagnosis::find_verdict;
  using rollrig::diagnosis::Verdict;
  Cause cause;
  cause.effects = {"a"};
  cause.indistinguishable_from = {"b", "c", "d"};
  cause.probability = 0.56;
  cause.adequate = true;
  CHECK(find_verdict({{"none", 0.40}, {"unknown", 0.04}, {"a", 0.2}, {"b", 0.2}, {"c", 0.1}}, {cause}) ==
        Verdict::kNoGap);
  CHECK(find_verdict({{"none", 0.20}, {"unknown", 0.04}, {"a", 0.3}, {"b", 0.2}, {"c", 0.1}}, {cause}) ==
        Verdict::kExplained);
  CHECK(find_verdict({{"none", 0.20}, {"unknown", 0.58}, {"a", 0.2}}, {cause}) == Verdict::kUnexplained);
  cause.indistinguishable_from = {"b", "c"};
  CHECK(find_verdict({{"none", 0.40}, {"unknown", 0.04}, {"a", 0.2}, {"b", 0.2}, {"c", 0.1}}, {cause}) ==
        Verdict::kExplained);
}

TEST_CASE("what speaks against a cause leaves it the share of truths with that objection, the rest is unknown",
          "[fast]") {
  using namespace rollrig::diagnosis;
  const auto judge = [](double kept) {
    Cause cause;
    cause.effects = {"a"};
    cause.probability = 0.9;
    cause.acts = 0.9;
    cause.alone = 0.8;
    cause.kept = kept;
    std::vector<Cause> causes{cause};
    std::map<std::string, double> probability{{"none", 0.05}, {"unknown", 0.05}, {"a", 0.9}};
    weigh_objections({}, causes, probability);
    CHECK(causes.front().probability == Approx(0.9 * kept));
    CHECK(*causes.front().alone == Approx(0.8 * kept));
    CHECK(probability.at("unknown") == Approx(0.05 + 0.9 * (1.0 - kept)));
    CHECK(probability.at("a") == Approx(0.9 * kept));
    return find_verdict(probability, causes);
  };
  CHECK(judge(1.0) == Verdict::kExplained);
  CHECK(judge(0.65) == Verdict::kExplained);
  CHECK(judge(0.1) == Verdict::kUnexplained);
}

TEST_CASE("a cause that the runs left out do not confirm is no explanation", "[fast]") {
  using namespace rollrig::diagnosis;
  const auto judge = [](Gap gap) {
    Cause cause;
    cause.effects = {"a"};
    cause.probability = 0.9;
    std::vector<Cause> causes{cause};
    std::map<std::string, double> probability{{"none", 0.05}, {"unknown", 0.05}, {"a", 0.9}};
    weigh_objections(gap, causes, probability);
    return find_verdict(probability, causes);
  };
  Gap gap;
  gap.held_out = gap.judged_on = {"1", "2"};
  gap.judged_by = JudgedBy::kRuns;
  gap.shrink_percent = 40.0;
  gap.shrink_ci95_percent = {12.0, 60.0};
  CHECK(judge(gap) == Verdict::kExplained);
  gap.shrink_percent = 10.0;
  gap.shrink_ci95_percent = {-22.0, 18.0};
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.held_out = gap.judged_on = {};  // one run: its stretches are judged
  gap.judged_by = JudgedBy::kStretches;
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.shrink_ci95_percent = {1.0, 18.0};
  CHECK(judge(gap) == Verdict::kExplained);
  gap.shrink_percent = 62.0;  // of a gap that is hardly above the noise: the likelihood decides
  gap.shrink_ci95_percent = {-2.0, 100.0};
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.left_out_nats = 50.0;
  gap.recalibrated.before = 1.2;
  CHECK(judge(gap) == Verdict::kExplained);
  gap.shrink_percent = 12.0;
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.recalibrated.before = 0.4;  // so faint that a shrinkage says nothing
  CHECK(judge(gap) == Verdict::kExplained);
  gap.worse_where_certain = true;
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.worse_where_certain = false;
  gap.recalibrated.before = 1.2;
  gap.judged_by = JudgedBy::kRuns;  // which do not decide, where the stretches do
  gap.stretches = Shrinkage{{1.2, 0.65}, 46.0, {31.0, 61.0}, std::nullopt};
  CHECK(judge(gap) == Verdict::kExplained);
  gap.stretches->ci95_percent[0] = -1.0;
  CHECK(judge(gap) == Verdict::kUnexplained);
  gap.shrink_percent.reset();  // no gap above the noise: what was left out judges by its likelihood
  gap.judged_by = JudgedBy::kNothing;
  gap.left_out_nats = 10.0;
  CHECK(judge(gap) == Verdict::kExplained);
  gap.left_out_nats = 2.0;
  CHECK(judge(gap) == Verdict::kUnexplained);
}

TEST_CASE("a cause that predicts what was left out keeps more, whatever its law or the files have to look like",
          "[fast]") {
  using namespace rollrig::diagnosis;
  const auto judge = [](double low_percent, double nats) {
    Gap gap;
    gap.judged_by = JudgedBy::kRuns;
    gap.shrink_percent = 70.0;
    gap.shrink_ci95_percent = {low_percent, 90.0};
    gap.left_out_nats = nats;
    Cause cause;
    cause.effects = {"a"};
    cause.probability = 0.9;
    cause.kept = 0.5;
    cause.kept_confirmed = 0.7;
    std::vector<Cause> causes{cause};
    std::map<std::string, double> probability{{"none", 0.05}, {"unknown", 0.05}, {"a", 0.9}};
    weigh_objections(gap, causes, probability);
    return causes.front().probability;
  };
  CHECK(judge(50.0, 100.0) == Approx(0.9 * 0.7));
  CHECK(judge(20.0, 100.0) == Approx(0.9 * 0.5));
  CHECK(judge(50.0, 1.0) == Approx(0.9 * 0.5));  // hardly likelier
}

TEST_CASE("the first cause stays first, the others follow by probability", "[fast]") {
  using namespace rollrig::diagnosis;
  std::vector<Cause> causes(4);
  const double probability[] = {0.4, 0.1, 0.5, 0.2};
  for (std::size_t i = 0; i < causes.size(); ++i) causes[i].probability = probability[i];
  sort_after_first(causes);
  std::vector<double> sorted;
  for (const Cause& cause : causes) sorted.push_back(cause.probability);
  CHECK(sorted == std::vector<double>{0.4, 0.5, 0.2, 0.1});
  causes.clear();
  CHECK_NOTHROW(sort_after_first(causes));
}

TEST_CASE("what an objection says names the parts that were left out", "[fast]") {
  using namespace rollrig::diagnosis;
  const auto object = [](JudgedBy by) {
    Gap gap;
    gap.judged_by = by;
    gap.shrink_percent = -20.0;
    gap.shrink_ci95_percent = {-40.0, 10.0};
    std::vector<Cause> causes(1);
    causes.front().effects = {"a"};
    std::map<std::string, double> probability{{"none", 0.1}, {"unknown", 0.1}, {"a", 0.8}};
    weigh_objections(gap, causes, probability);
    return causes.front().objections.at(0);
  };
  CHECK(object(JudgedBy::kRuns).rfind("the runs left out do not confirm it", 0) == 0);
  CHECK(object(JudgedBy::kStretches).rfind("the stretches left out do not confirm it", 0) == 0);
}
