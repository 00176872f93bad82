#include "validation/scoring/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

using diagnosis::Verdict;

/// What an ideal observer makes of the cases: rollrig-blind-ceiling/1, `sets` with `d_prime`, `identifiable`,
/// `log_bayes_factors`.
void read_upper_bound(const std::string& set, const std::string& file, std::vector<Case>& cases) {
  if (file.empty()) return;
  try {
    const Json json = read_json(file);
    const bool is_of_another =
        json.contains("truth_sha256") && json["truth_sha256"] != calc_sha256(read_text_file(set + "/truth.json"));
    if (is_of_another) {
      throw InputError({"the upper bound is of another validation set's truth", file, 0, "truth_sha256",
                        json["truth_sha256"].dump(), "rollrig_validation upper-bound " + set + " makes this set's own",
                        ""});
    }
    for (Case& one : cases) {
      const auto at = json.at("sets").find(one.truth.number);
      if (at == json.at("sets").end()) continue;
      if (at->contains("d_prime")) one.d_prime = at->at("d_prime").get<double>();
      if (one.d_prime.has_value() && !(*one.d_prime >= 0.0)) {
        throw InputError({"a d' below zero", file, 0, one.truth.number + " d_prime", fmt::format("{}", *one.d_prime),
                          "0 or more, as rollrig_validation upper-bound writes it", ""});
      }
      const Json nats_by_effect = at->value("log_bayes_factors", Json::object());
      for (const Json& nats : nats_by_effect) one.log_bayes_factors.push_back(nats.get<double>());
      if (at->contains("identifiable")) one.identifiable = at->at("identifiable").get<bool>();
    }
  } catch (const Json::exception& error) {
    throw InputError({fmt::format("not an upper bound of a validation set: {}", error.what()), file, 0, "--upper-bound",
                      file, kUpperBoundFormat, ""});
  }
}

/// Where the effects act: rollrig-validation-locations/1.
void read_locations(const std::string& set, const std::string& file, std::vector<Case>& cases) {
  if (file.empty()) return;
  const std::string command = "rollrig_validation locations " + set;
  try {
    const Json json = read_json(file);
    if (json.at("format") != kLocationsFormat) {
      throw InputError(
          {"no locations of a validation set", file, 0, "format", json["format"].dump(), kLocationsFormat, ""});
    }
    if (json.at("truth_sha256") != calc_sha256(read_text_file(set + "/truth.json"))) {
      throw InputError({"the locations are of another validation set's truth", file, 0, "truth_sha256",
                        json["truth_sha256"].dump(), command + " makes this set's own", ""});
    }
    for (Case& one : cases) {
      const auto at = json.at("sets").find(one.truth.number);
      if (at != json.at("sets").end()) one.places = read_places(*at);
    }
  } catch (const Json::exception& error) {
    throw InputError({fmt::format("no locations of a validation set: {}", error.what()), file, 0, "", "",
                      "a file as " + command + " writes it", ""});
  }
}

std::string how_to_answer(const ScoreOrder& order) {
  const std::string program = "rollrig_validation ";
  if (order.by_baseline) return program + "baselines " + order.set;
  if (order.truth_was_left_out) {
    return fmt::format("{}known-cause {} --cause left_out --out {}", program, order.set, order.answers);
  }
  return fmt::format("{}run {} --out {}", program, order.set, order.answers);
}

}  // namespace

bool Figure::meets(const std::optional<double>& bar) const {
  if (!bar.has_value() || !value.has_value()) return false;
  return more_is_better ? *value >= *bar : *value <= *bar;
}

void Tally::add(const Case& one) {
  ++cases;
  failed += one.answer.failure.empty() ? 0 : 1;
  no_gap += one.is(Verdict::kNoGap) ? 1 : 0;
  unexplained += one.is(Verdict::kUnexplained) ? 1 : 0;
  if (one.is(Verdict::kExplained)) {
    (one.is_named() ? named : named_wrong) += 1;
    named_effects += one.named_set().size();
  }
  right_above += one.is_right_above(kConfident) ? 1 : 0;
  wrong_above += one.is_wrong_above(kConfident) ? 1 : 0;
}

double Tally::mean_named_set() const {
  return static_cast<double>(named_effects) / static_cast<double>(std::max<std::size_t>(1, named + named_wrong));
}

void LocationTally::add(const Case& one) {
  const std::vector<diagnosis::Location> locations = one.scored_locations();
  if (locations.empty()) return;
  ++answers;
  const LocationCheck first = check_largest(locations.front(), one.places);
  channel += first.channel ? 1 : 0;
  run += first.run ? 1 : 0;
  phase += first.phase ? 1 : 0;
  all_three += first.is_right() ? 1 : 0;
  for (const diagnosis::Location& at : locations) {
    ++named;
    shifted += is_shifted(at, one.places) ? 1 : 0;
  }
}

std::vector<ReliabilityGroup> group_reliability(const std::vector<Case>& cases) {
  std::map<std::string, std::map<Verdict, ReliabilityBin>> bins;
  std::map<Verdict, ReliabilityBin> all;
  for (const Case& one : cases) {
    if (!one.answer.failure.empty()) continue;
    const Verdict verdict = one.answer.diagnosis.verdict;
    bins[one.truth.kind][verdict].add(one.stated());
    all[verdict].add(one.stated());
  }
  std::vector<ReliabilityGroup> groups;
  const auto add = [&groups](const std::string& kind, const std::map<Verdict, ReliabilityBin>& by_verdict) {
    for (const Verdict verdict : {Verdict::kNoGap, Verdict::kExplained, Verdict::kUnexplained}) {
      const auto at = by_verdict.find(verdict);
      if (at != by_verdict.end()) groups.push_back({kind, verdict, at->second});
    }
  };
  for (const auto& [kind, by_verdict] : bins) add(kind, by_verdict);
  if (bins.size() > 1) add(kAllKinds, all);
  return groups;
}

Score score_cases(const std::vector<Case>& cases, const ScoreOptions& options) {
  Score score;
  score.cases = cases.size();
  score.figures = find_figures(cases, options);
  std::set<std::string> programs;
  for (const Case& one : cases) {
    score.by_effect[one.is_triple() ? "triples" : one.is_pair() ? "pairs" : one.truth.name()].add(one);
    score.by_campaign[one.truth.campaign].add(one);
    if (!one.is_clean()) score.all_effects.add(one);
    if (one.is_single() && !one.truth.effects.front().size_class.empty()) {
      score.by_size_class[one.truth.effects.front().size_class].add(one);
    }
    ++score.confusion[one.truth.name()][one.said()];
    if (!one.is_right()) score.missed.push_back(one);
    if (one.next_test.has_value() || one.drawn_test.has_value()) score.followed_up.push_back(one);
    if (!one.places.empty()) {
      score.locations[one.truth.kind].add(one);
      score.locations[kAllKinds].add(one);
    }
    programs.insert(one.answer.settings.program_sha256);
  }
  score.reliability = find_reliability(list_stated(cases));
  score.reliability_groups = group_reliability(cases);
  const auto lacks_d_prime = [](const Case& one) { return one.is_inside() && !one.d_prime.has_value(); };
  const auto lacking = std::count_if(cases.begin(), cases.end(), lacks_d_prime);
  const bool any_known =
      std::any_of(cases.begin(), cases.end(), [](const Case& one) { return one.d_prime.has_value(); });
  if (lacking > 0 && any_known) {
    score.warnings.push_back(fmt::format(
        "the upper bound lacks {} of the cases: of these a signal of {:.2g} noise floors counts as detectable", lacking,
        options.detectable_floors));
  }
  if (programs.size() > 1) {
    score.warnings.push_back(fmt::format("the answers are of {} different programs", programs.size()));
  }
  if (!any_known) {
    score.warnings.push_back(
        fmt::format("no d' is known: \"detectable\" is a signal of {:g} noise floors or more in one channel, before "
                    "calibration, and takes all these effects for identifiable",
                    options.detectable_floors));
  }
  return score;
}

std::vector<Case> read_cases(const ScoreOrder& order) {
  std::vector<Case> cases;
  std::size_t lacking = 0;
  std::size_t all = 0;
  for (Truth& truth : read_truths(order.set, order.hash)) {
    if (order.truth_was_left_out && (truth.effects.empty() || truth.outside)) continue;  // known-cause skips these
    ++all;
    std::optional<Answer> answer = find_answer_to(order.set, order.answers, truth.number);
    if (!answer.has_value()) {
      ++lacking;
      continue;
    }
    truth.outside = truth.outside || order.truth_was_left_out;
    Case one;
    one.truth = std::move(truth);
    one.answer = *std::move(answer);
    const auto alone = order.known_cause.empty() ? std::nullopt : find_answer(order.known_cause, one.truth.number);
    if (alone && alone->set_sha256 == one.answer.set_sha256) {
      one.known_cause_shrink_percent = alone->diagnosis.gap.shrink_percent;
    }
    cases.push_back(std::move(one));
  }
  require_answers(lacking, all, order.answers, how_to_answer(order));
  read_upper_bound(order.set, order.upper_bound, cases);
  read_locations(order.set, order.locations, cases);
  read_follow_ups(order.set, Choice::kProposed, order.next_tests, cases);
  read_follow_ups(order.set, Choice::kDrawn, order.drawn_tests, cases);
  return cases;
}

}  // namespace rollrig::validation
