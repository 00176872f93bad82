#include "validation/scoring/answer.h"

#include <fmt/format.h>

#include <filesystem>

#include "diagnosis/output/diagnosis_json.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

constexpr const char* kAnswerFormat = "rollrig-blind-answer/1";

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
    static_cast<Findings&>(answer.diagnosis) = diagnosis::read_diagnosis_json(json.at("diagnosis"));
  }
  return answer;
}

std::string answer_file(const std::string& folder, const std::string& number) {
  return (fs::path(folder) / (number + ".json")).string();
}

void write_answer_json(const std::string& folder, const std::string& number, const Json& answer) {
  write_file_atomically(answer_file(folder, number), to_text(answer, 1));
}

void write_answer(const std::string& folder, const Answer& answer) {
  write_answer_json(folder, answer.number, make_answer_json(answer));
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
