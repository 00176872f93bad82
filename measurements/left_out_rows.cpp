#include "measurements/left_out_rows.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "sim/core/text.h"

namespace rollrig::measurements {
namespace {

constexpr double kMostBadRows = 0.05;  // Assumed: share of the rows of a file

bool are_few(const FileProblems& file) {
  const auto bad = static_cast<double>(count_rows(file.problems));
  return bad <= std::max(1.0, kMostBadRows * static_cast<double>(file.file_rows));
}

/// The first three problems, and the number of the others.
std::string list_first(const RowProblems& problems) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, problems.size()); ++i) {
    const InputProblem& problem = problems[i];
    text += fmt::format("{}line {}: {}{}", i == 0 ? "" : "; ", problem.line,
                        problem.key.empty() ? "" : problem.key + " ", problem.value);
  }
  return problems.size() <= kMost ? text : text + fmt::format("; and {} more", problems.size() - kMost);
}

}  // namespace

InputError make_bad_rows_error(const std::vector<FileProblems>& files, const std::string& hint) {
  RowProblems all;
  std::size_t bad_files = 0;
  bool can_be_left_out = true;
  for (const FileProblems& file : files) {
    all.insert(all.end(), file.problems.begin(), file.problems.end());
    bad_files += file.problems.empty() ? 0 : 1;
    can_be_left_out = can_be_left_out && are_few(file);
  }
  const std::string where =
      files.size() == 1 ? "" : fmt::format(" in {} of {}", bad_files, format_count(files.size(), "file"));
  return make_rows_error(format_count(count_rows(all), "bad row") + where, all,
                         can_be_left_out ? "with --skip-bad-rows, bad rows are left out"
                                         : "bad rows can be left out only if they are few: 5 % of a file",
                         hint);
}

void require_few_bad_rows(const FileProblems& file, const std::string& of, const std::string& hint) {
  if (are_few(file)) return;
  throw make_rows_error(fmt::format("{} of {} rows of {} are bad: too many to leave them out",
                                    count_rows(file.problems), file.file_rows, of),
                        file.problems, fmt::format("bad rows: at most {:.0f} % of a file", 100.0 * kMostBadRows), hint);
}

std::string describe_left_out(const LeftOutRows& out, const std::string& of, const std::string& file,
                              const std::string& field) {
  const std::string fields =
      out.fields == 0 ? "" : fmt::format(", {} of other rows left empty", format_count(out.fields, field));
  return fmt::format("bad rows{}: {} of {} rows left out{} ({}, {})", of, out.rows, out.file_rows, fields,
                     std::filesystem::path(file).filename().string(), list_first(out.problems));
}

Json make_left_out_json(const LeftOutRows& out, const std::string& file) {
  Json bad = Json::array();
  for (const InputProblem& problem : out.problems) {
    bad.push_back({{"line", problem.line},
                   {"column", problem.key},
                   {"value", problem.value},
                   {"problem", problem.what},
                   {"allowed", problem.allowed}});
  }
  return {{"file", file},
          {"rows", out.file_rows},
          {"rows_left_out", out.rows},
          {"fields_left_empty", out.fields},
          {"bad", bad}};
}

}  // namespace rollrig::measurements
