#include "validation/scoring/answer.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "diagnosis/output/diagnosis_json.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

constexpr const char* kAnswerFormat = "rollrig-blind-answer/1";

double read_number(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

diagnosis::Cause read_cause(const Json& json) {
  diagnosis::Cause cause;
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

diagnosis::Location read_location(const Json& json) {
  diagnosis::Location at;
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

diagnosis::Diagnosis read_diagnosis(const Json& json) {
  diagnosis::Diagnosis read;
  read.set = json.at("set").get<std::string>();
  read.verdict = diagnosis::read_verdict(json.at("verdict").get<std::string>());
  for (const auto& [name, value] : json.at("probability").items()) read.probability[name] = read_number(value);
  for (const Json& cause : json.at("causes")) read.causes.push_back(read_cause(cause));
  if (json.contains("trace") && json["trace"].is_object()) read.trace = read_cause(json["trace"]);
  if (json.contains("nothing_detectable") && json["nothing_detectable"].is_number()) {
    read.nothing_detectable = json["nothing_detectable"].get<double>();
  }
  const Json& gap = json.at("gap");
  const auto read_view = [&gap](const char* key) -> diagnosis::GapView {
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
  return read;
}

}  // namespace

bool operator==(const Settings& a, const Settings& b) {
  return a.program_sha256 == b.program_sha256 && a.only == b.only && a.without == b.without;
}

std::string hash_program() { return calc_sha256(read_bytes("/proc/self/exe")); }

Json make_answer_json(const Answer& answer) {
  Json json = {{"format", kAnswerFormat},
               {"set", answer.number},
               {"set_sha256", answer.set_sha256},
               {"program_sha256", answer.settings.program_sha256},
               {"only", answer.settings.only},
               {"without", answer.settings.without},
               {"seconds", answer.seconds},
               {"cpu_seconds", answer.cpu_seconds},
               {"failure", answer.failure.empty() ? Json(nullptr) : Json(answer.failure)}};
  json["diagnosis"] = answer.failure.empty() ? diagnosis::make_diagnosis_json(answer.diagnosis) : Json(nullptr);
  return json;
}

Answer read_answer_json(const Json& json) {
  if (json.at("format") != kAnswerFormat) {
    throw InputError({"not an answer to a case", "", 0, "format", json.at("format").dump(), kAnswerFormat, ""});
  }
  Answer answer;
  answer.number = json.at("set").get<std::string>();
  answer.set_sha256 = json.at("set_sha256").get<std::string>();
  answer.settings.program_sha256 = json.at("program_sha256").get<std::string>();
  answer.settings.only = json.at("only").get<std::vector<std::string>>();
  answer.settings.without = json.at("without").get<std::vector<std::string>>();
  answer.seconds = json.at("seconds").get<double>();
  answer.cpu_seconds = json.at("cpu_seconds").get<double>();
  if (json.at("failure").is_string()) {
    answer.failure = json.at("failure").get<std::string>();
  } else {
    answer.diagnosis = read_diagnosis(json.at("diagnosis"));
  }
  return answer;
}

std::string answer_file(const std::string& folder, const std::string& number) {
  return (fs::path(folder) / (number + ".json")).string();
}

void write_answer(const std::string& folder, const Answer& answer) {
  write_file_atomically(answer_file(folder, answer.number), to_text(make_answer_json(answer), 1));
}

std::optional<Answer> find_answer(const std::string& folder, const std::string& number) {
  const std::string file = answer_file(folder, number);
  if (!fs::exists(file)) return std::nullopt;
  try {
    Answer answer = read_answer_json(read_json(file));
    if (answer.number == number) return answer;
  } catch (const Json::exception&) {  // of another program, or spoiled: as if it were not there
  } catch (const InputError&) {
  }
  return std::nullopt;
}

std::optional<Answer> find_answer_to(const std::string& set, const std::string& folder, const std::string& number) {
  std::optional<Answer> answer = find_answer(folder, number);
  if (answer.has_value() && answer->set_sha256 != hash_case(case_folder(set, number))) return std::nullopt;
  return answer;
}

void require_answers(std::size_t lacking, std::size_t all, const std::string& folder, const std::string& how) {
  if (lacking == 0) return;
  throw InputError({fmt::format("{} of {} cases have no answer to their files as they are now", lacking, all), folder,
                    0, "", "", "first: " + how, ""});
}

}  // namespace rollrig::validation
