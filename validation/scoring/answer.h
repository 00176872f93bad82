#pragma once
/// One answer of the diagnosis in a file: answers/<number>.json.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "sim/core/json.h"

namespace rollrig::validation {

/// What an answer depends on beside the case.
struct Settings {
  std::string program_sha256;        // of the program that answers
  std::vector<std::string> only;     // effects in the comparison; empty: all
  std::vector<std::string> without;  // effects left out of it
};
bool operator==(const Settings& a, const Settings& b);

/// SHA-256 of the program that runs.
std::string hash_program();

struct Answer {
  std::string number;      // of the case
  std::string set_sha256;  // of its files
  Settings settings;
  diagnosis::Diagnosis diagnosis;  // read back: verdict, probability, causes, gap, where, next tests without their runs
  std::string failure;             // why there is no diagnosis
  double seconds = 0.0;            // on one thread
  double cpu_seconds = 0.0;
};

/// rollrig-blind-answer/1.
Json make_answer_json(const Answer& answer);
/// Throws Json::exception or InputError where it is no such answer.
Answer read_answer_json(const Json& json);

std::string answer_file(const std::string& folder, const std::string& number);
/// Each writes the file whole or not at all.
void write_answer_json(const std::string& folder, const std::string& number, const Json& answer);
void write_answer(const std::string& folder, const Answer& answer);
/// None where there is no file, or one that is no answer.
std::optional<Answer> find_answer(const std::string& folder, const std::string& number);
/// Likewise, and none where the answer is to other files than those that the case has now.
std::optional<Answer> find_answer_to(const std::string& set, const std::string& folder, const std::string& number);

/// Throws InputError where cases lack an answer; `how` is the command that answers them.
void require_answers(std::size_t lacking, std::size_t all, const std::string& folder, const std::string& how);

}  // namespace rollrig::validation
