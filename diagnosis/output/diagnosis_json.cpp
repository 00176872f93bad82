#include "diagnosis/output/diagnosis_json.h"

#include <cmath>
#include <limits>

#include "sim/core/error.h"

namespace rollrig::diagnosis {
namespace {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value.has_value() ? number(*value) : Json(nullptr); }

/// A number that must exist: to_text() refuses one that is not finite.
Json finite(double value) { return value; }
Json finite(const std::optional<double>& value) { return value.has_value() ? Json(*value) : Json(nullptr); }

/// The limit on which an estimate is: lower or upper; else null.
Json make_limit(RangeLimit limit) {
  if (limit == RangeLimit::kNone) return nullptr;
  return limit == RangeLimit::kLower ? "lower" : "upper";
}

Json make_parameter(const ParameterEstimate& parameter) {
  return {{"name", parameter.name},
          {"value", number(parameter.value)},
          {"sd", number(parameter.sd)},
          {"low_95", number(parameter.low_95)},
          {"high_95", number(parameter.high_95)},
          {"unit", parameter.unit},
          {"on_limit", make_limit(parameter.on_limit)}};
}

Json make_base_number(const BaseNumber& base) {
  const char* sources[] = {"file", "usual", "class"};
  return {{"name", base.name},
          {"unit", base.unit},
          {"value", number(base.value)},
          {"sd", number(base.sd)},
          {"sd_source", sources[static_cast<int>(base.sd_source)]},
          {"recalibrated", number(base.recalibrated)},
          {"moved_sd", number(base.moved_sd)},
          {"with_cause", number(base.with_cause)},
          {"with_cause_moved_sd", number(base.with_cause_moved_sd)}};
}

Json make_change(const std::optional<CauseChange>& change) {
  if (!change.has_value()) return nullptr;
  return {{"floors", number(change->floors)}, {"energy_percent", number(change->energy_percent)}};
}

Json make_partner(const Partner& partner) {
  return {{"effect", partner.effect}, {"probability", finite(partner.probability)}};
}

Json make_cause(const Cause& cause) {
  return {{"effects", cause.effects},
          {"probability", finite(cause.probability)},
          {"indistinguishable_from", cause.indistinguishable_from},
          {"parameters", make_list(cause.parameters, make_parameter)},
          {"acts", finite(cause.acts)},
          {"alone", finite(cause.alone)},
          {"complete", finite(cause.complete)},
          {"partners", make_list(cause.partners, make_partner)},
          {"adequate", cause.adequate},
          {"objections", cause.objections},
          {"companions", cause.companions},
          {"change", make_change(cause.change)}};
}

Json make_view(const GapView& view) { return {{"before", number(view.before)}, {"after", number(view.after)}}; }

Json make_interval(const std::optional<double>& percent, const std::array<double, 2>& ci95) {
  return percent.has_value() ? Json::array({number(ci95[0]), number(ci95[1])}) : Json(nullptr);
}

Json make_shrinkage(const std::optional<Shrinkage>& shrinkage) {
  if (!shrinkage.has_value()) return nullptr;
  return {{"before", number(shrinkage->gap.before)},
          {"after", number(shrinkage->gap.after)},
          {"percent", number(shrinkage->percent)},
          {"ci95_percent", make_interval(shrinkage->percent, shrinkage->ci95_percent)},
          {"energy_percent", shrinkage->energy_percent.has_value() ? make_view(*shrinkage->energy_percent) : Json()}};
}

/// What the shrinkage is judged on; null where nothing can judge it.
Json make_judge(JudgedBy by) {
  if (by == JudgedBy::kNothing) return nullptr;
  return by == JudgedBy::kRuns ? "runs_left_out" : "stretches_left_out";
}

Json make_gap_step(const GapStep& step) {
  return {{"name", step.name},
          {"floors", number(step.floors)},
          {"energy_percent", number(step.energy_percent)},
          {"channels", make_list(step.channels, [](const rollrig::ChannelRest& at) -> Json {
             return {{"channel", at.channel}, {"unit", at.unit}, {"rms", number(at.rms)}};
           })}};
}

Json make_gap(const Gap& gap) {
  return {
      {"as_calibrated", make_view(gap.as_calibrated)},
      {"recalibrated", make_view(gap.recalibrated)},
      {"shrink_percent", number(gap.shrink_percent)},
      {"shrink_ci95_percent", make_interval(gap.shrink_percent, gap.shrink_ci95_percent)},
      {"judged_by", make_judge(gap.judged_by)},
      {"fitted", make_shrinkage(gap.fitted)},
      {"stretches_left_out", make_shrinkage(gap.stretches)},
      {"runs_left_out", make_shrinkage(gap.runs)},
      {"left_out_nats", number(gap.left_out_nats)},
      {"recalibration_percent", number(gap.recalibration_percent)},
      {"black_box_percent", number(gap.black_box_percent)},
      {"held_out", gap.held_out},
      {"judged_on", gap.judged_on},
      {"not_judged", make_list(gap.not_judged,
                               [](const UnjudgedRun& at) -> Json {
                                 return {{"run", at.run}, {"alone_in", at.alone_in}};
                               })},
      {"unit", "noise floors"},
      {"steps", make_list(gap.steps, make_gap_step)},
      {"channels", make_list(gap.channels, [](const ChannelGap& at) -> Json {
         return {
             {"channel", at.channel}, {"unit", at.unit}, {"before", number(at.before)}, {"after", number(at.after)}};
       })}};
}

Json make_location(const Location& at) {
  return {
      {"channel", at.channel},    {"run", at.run},   {"phase", at.phase}, {"share_percent", number(at.share_percent)},
      {"size", number(at.size)},  {"unit", at.unit}, {"z", number(at.z)}, {"start_s", number(at.start_s)},
      {"end_s", number(at.end_s)}};
}

Json make_likeness(const std::optional<Likeness>& like) {
  if (!like.has_value()) return nullptr;
  return {{"text", like->text}, {"probability", finite(like->probability)}, {"beside", like->beside}};
}

Json make_lone_run(const std::optional<LoneRun>& lone) {
  if (!lone.has_value()) return nullptr;
  return {{"run", lone->run},
          {"share_percent", number(lone->share_percent)},
          {"verdict", name_of(lone->verdict)},
          {"effects", lone->effects},
          {"probability", finite(lone->probability)}};
}

double read_number(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Cause read_cause(const Json& json) {
  Cause cause;
  cause.effects = json.at("effects").get<std::vector<std::string>>();
  cause.probability = read_number(json.at("probability"));
  cause.indistinguishable_from = json.at("indistinguishable_from").get<std::vector<std::string>>();
  for (const Json& of : json.at("parameters")) {
    cause.parameters.push_back({of.at("name").get<std::string>(), read_number(of.at("value")), read_number(of.at("sd")),
                                read_number(of.at("low_95")), read_number(of.at("high_95")),
                                of.at("unit").get<std::string>()});
  }
  const auto read_optional = [&json](const char* key) -> std::optional<double> {
    return json.contains(key) && json[key].is_number() ? std::optional<double>(json[key].get<double>()) : std::nullopt;
  };
  cause.acts = read_optional("acts");
  cause.alone = read_optional("alone");
  cause.complete = read_optional("complete");
  cause.adequate = json.at("adequate").get<bool>();
  cause.objections = json.at("objections").get<std::vector<std::string>>();
  return cause;
}

Location read_location(const Json& json) {
  Location at;
  at.channel = json.at("channel").get<std::string>();
  at.run = json.at("run").get<std::string>();
  at.phase = json.at("phase").get<std::string>();
  at.share_percent = read_number(json.at("share_percent"));
  at.size = read_number(json.at("size"));
  at.unit = json.at("unit").get<std::string>();
  at.z = read_number(json.at("z"));
  at.start_s = read_number(json.at("start_s"));
  at.end_s = read_number(json.at("end_s"));
  return at;
}

}  // namespace

const char* name_of(Verdict verdict) {
  if (verdict == Verdict::kNoGap) return "no_gap";
  return verdict == Verdict::kExplained ? "explained" : "unexplained";
}

Verdict read_verdict(const std::string& word) {
  for (const Verdict verdict : {Verdict::kNoGap, Verdict::kExplained, Verdict::kUnexplained}) {
    if (word == name_of(verdict)) return verdict;
  }
  throw InputError({"unknown verdict", "", 0, "verdict", word, "no_gap, explained, unexplained", ""});
}

Json make_diagnosis_json(const Findings& findings) {
  Json probability = Json::object();
  for (const auto& [name, value] : findings.probability) probability[name] = finite(value);
  const auto make_balance = [](const BalanceShare& share) -> Json {
    return {{"name", share.name}, {"share_percent", number(share.share_percent)}};
  };
  const auto make_next_test = [](const NextTest& next) -> Json {
    return {{"test", next.test},
            {"splits", next.splits},
            {"expected_bits_per_hour", number(next.expected_bits_per_hour)},
            {"hours", number(next.hours)}};
  };
  const auto make_next_sensor = [](const NextSensor& next) -> Json {
    return {{"sensor", next.sensor},
            {"splits", next.splits},
            {"expected_bits", number(next.expected_bits)},
            {"hours", number(next.hours)}};
  };
  return {{"format", "rollrig-diagnosis/1"},
          {"set", findings.set},
          {"only", findings.only},
          {"without", findings.without},
          {"verdict", name_of(findings.verdict)},
          {"probability", probability},
          {"nothing_detectable", finite(findings.nothing_detectable)},
          {"causes", make_list(findings.causes, make_cause)},
          {"trace", findings.trace.has_value() ? make_cause(*findings.trace) : Json(nullptr)},
          {"unknown_like", make_likeness(findings.unknown_like)},
          {"gap", make_gap(findings.gap)},
          {"where", make_list(findings.where, make_location)},
          {"balance", make_list(findings.balance, make_balance)},
          {"base_numbers", make_list(findings.base_numbers, make_base_number)},
          {"next_test", make_list(findings.next_tests, make_next_test)},
          {"next_sensor", make_list(findings.next_sensors, make_next_sensor)},
          {"not_excluded", findings.not_excluded},
          {"without_run", make_lone_run(findings.without_run)},
          {"warnings", findings.warnings}};
}

Findings read_diagnosis_json(const Json& json) {
  Findings read;
  read.set = json.at("set").get<std::string>();
  read.only = json.value("only", std::vector<std::string>());
  read.without = json.value("without", std::vector<std::string>());
  read.verdict = read_verdict(json.at("verdict").get<std::string>());
  for (const auto& [name, value] : json.at("probability").items()) read.probability[name] = read_number(value);
  for (const Json& cause : json.at("causes")) read.causes.push_back(read_cause(cause));
  if (json.contains("trace") && json["trace"].is_object()) read.trace = read_cause(json["trace"]);
  if (json.contains("nothing_detectable") && json["nothing_detectable"].is_number()) {
    read.nothing_detectable = json["nothing_detectable"].get<double>();
  }
  const Json& gap = json.at("gap");
  const auto read_view = [&gap](const char* key) -> GapView {
    return {read_number(gap.at(key).at("before")), read_number(gap.at(key).at("after"))};
  };
  read.gap.as_calibrated = read_view("as_calibrated");
  read.gap.recalibrated = read_view("recalibrated");
  if (gap.at("shrink_percent").is_number()) read.gap.shrink_percent = gap.at("shrink_percent").get<double>();
  for (const Json& of : json.at("next_test")) {
    read.next_tests.push_back({of.at("test").get<std::string>(), of.at("splits").get<std::vector<std::string>>(),
                               read_number(of.at("expected_bits_per_hour")), read_number(of.at("hours"))});
  }
  for (const Json& at : json.value("where", Json::array())) read.where.push_back(read_location(at));
  read.warnings = json.value("warnings", std::vector<std::string>());
  return read;
}

}  // namespace rollrig::diagnosis
