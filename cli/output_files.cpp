#include "cli/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/message.h"
#include "rollrig/measurement_set.h"
#include "sim/core/interrupt.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

InputError bad_place(const std::string& what, const OutputFile& file) {
  return usage_error(what, file.option, file.path, "another place");
}

/// Whether two names, of files or folders that may not be there yet, mean one place; "-" means standard output.
bool is_same_place(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  // Absolute first: of what is not there yet only the parts that are there become canonical.
  const auto full = [](const std::string& path) {
    return (fs::weakly_canonical(fs::absolute(path)) / "").lexically_normal();
  };
  return full(a) == full(b);
}

/// Throws InputError where two of them mean one place. An empty path means that the option was not given.
void require_apart(const std::vector<OutputFile>& files) {
  for (auto file = files.begin(); file != files.end(); ++file) {
    for (auto other = files.begin(); other != file; ++other) {
      if (other->path.empty() || file->path.empty() || !is_same_place(other->path, file->path)) continue;
      throw bad_place(fmt::format("{} and {} cannot both go to one place", other->option, file->option), *file);
    }
  }
}

const OutputOptions& require_apart(const OutputOptions& options, std::vector<OutputFile> folders) {
  folders.insert(folders.begin(), {"--out", options.folder});
  folders.push_back({"--json", options.json});
  folders.push_back({"--html", options.html});
  folders.push_back({"--report", options.report});
  require_apart(folders);
  return options;
}

}  // namespace

OutputFiles::OutputFiles(std::vector<OutputFile> files) : files_(std::move(files)) {
  files_.erase(std::remove_if(files_.begin(), files_.end(), [](const OutputFile& file) { return file.path.empty(); }),
               files_.end());
  require_apart(files_);
  for (const OutputFile& file : files_) require_writable(file.path);
  require_no_input();
}

void OutputFiles::require_no_input() const {
  for (const OutputFile& file : files_) {
    if (file.path == "-" || !was_read(file.path)) continue;
    throw bad_place(fmt::format("'{}' is read by this command, and would be lost", file.path), file);
  }
}

CLI::Option* add_output_option(CLI::App& command, const std::string& option, std::string& path,
                               const std::string& doc) {
  const auto set = [&path, option](const std::string& given) {
    if (given.empty()) throw usage_error("the name of what is to be written is empty", option, given, "a name");
    path = given;
  };
  return command.add_option_function<std::string>(option, set, doc);
}

void add_html_option(CLI::App& command, std::string& path) {
  add_output_option(command, "--html", path, "File for a page with charts, for any browser; - for standard output");
}

std::string note_page(const std::string& path) {
  return path.empty() || path == "-" ? "" : fmt::format("  page written to {}\n", path);
}

void OutputOptions::add_to(CLI::App& command, const char* json_doc, const char* folder_doc) {
  if (folder_doc != nullptr) add_output_option(command, "--out", folder, folder_doc);
  add_output_option(command, "--json", json, json_doc);
  add_html_option(command, html);
  if (folder_doc != nullptr) command.add_flag("--force", force, "Write into a folder that holds files");
  command.add_flag("--quiet", quiet, "Print nothing but errors");
}

void OutputOptions::add_report_to(CLI::App& command) {
  add_output_option(command, "--report", report, "File for a test report to print on A4 (HTML); - for standard output");
}

Output::Output(const OutputOptions& options, std::vector<OutputFile> folders)
    : options_(require_apart(options, std::move(folders))),
      folder_(options.folder.empty() ? std::nullopt
                                     : std::optional<OutputFolder>(std::in_place, options.folder, options.force)),
      files_({{"--json", options.json}, {"--html", options.html}, {"--report", options.report}}) {}

void Output::stage(const Report& report) {
  files_.require_no_input();
  // All are made before the first is written, so that a failure costs no room.
  const FolderFiles files = folder_.has_value() ? report.make_files() : FolderFiles();
  const std::string page = options_.html.empty() ? "" : report.make_page();
  const std::string test_report = options_.report.empty() ? "" : report.make_test_report();
  if (folder_.has_value()) {
    stage(*folder_, files);
    for (const auto& [name, content] : files) {
      const std::string shown = name.substr(0, name.find('/') == std::string::npos ? name.size() : name.find('/') + 1);
      if (written_.empty() || written_.back() != shown) written_.push_back(shown);
    }
  }
  if (!options_.json.empty()) staged_files_.emplace_back(options_.json, report.json);
  if (!options_.html.empty()) staged_files_.emplace_back(options_.html, page);
  if (!options_.report.empty()) staged_files_.emplace_back(options_.report, test_report);
}

void Output::stage(OutputFolder& folder, const FolderFiles& files) {
  for (const auto& [name, content] : files) folder.add(name, content);
  folder.flush();
  staged_folders_.push_back(&folder);
}

void Output::finish(const std::string& text, const std::string& notes) {
  commit(text);
  if (options_.is_silent()) return;
  std::cout << note_page(options_.html);
  if (!options_.report.empty()) std::cout << fmt::format("  test report written to {}\n", options_.report);
  if (!written_.empty()) std::cout << fmt::format("  written to {}/: {}\n", options_.folder, fmt::join(written_, " "));
  std::cout << notes;
}

void Output::commit(const std::string& text) {
  commit_all(staged_files_, staged_folders_, options_.is_silent() ? "" : text);
}

void commit_all(std::vector<StagedOutput>& files, const std::vector<OutputFolder*>& folders, const std::string& text) {
  throw_if_interrupted();
  for (StagedOutput& file : files) {
    if (file.is_direct()) file.commit();
  }
  if (!text.empty()) {
    std::cout << text;
    flush_standard_output();
  }
  for (OutputFolder* folder : folders) folder->commit();
  for (StagedOutput& file : files) {
    if (!file.is_direct()) file.commit();
  }
}

void warn_of_undescribed(const std::string& folder) {
  const std::vector<std::string> left_out = find_undescribed_folders(folder);
  if (left_out.empty()) return;
  std::cerr << wrap_message(
      fmt::format("warning: left out, since they have CSV files and no set.toml: {}", fmt::join(left_out, ", ")));
}

}  // namespace rollrig::cli
