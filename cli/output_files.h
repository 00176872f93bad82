#pragma once
/// What a command writes: --out, --json, --html and their like.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "rollrig/result.h"
#include "sim/core/file_io.h"
#include "sim/core/json.h"

namespace rollrig::cli {

/// An option that names a file or folder to write, and what was given; empty where nothing was.
struct OutputFile {
  const char* option;
  std::string path;
};

/// The files of one command. An older file at such a place is replaced, as a compiler does, so that a command can be
/// given again; only what the command itself reads is not.
class OutputFiles {
 public:
  /// To be made before the work. Throws InputError where a file could not be written, where two go to one place, or
  /// where one has been read.
  explicit OutputFiles(std::vector<OutputFile> files);

  /// To be called before the first of them, or a folder, is written. Throws InputError where one has been read since.
  void require_no_input() const;

 private:
  std::vector<OutputFile> files_;
};

/// An option that names a file or folder to write, which may not be empty: `--out ""` is a slip, such as a variable of
/// a script that is not set.
CLI::Option* add_output_option(CLI::App& command, const std::string& option, std::string& path, const std::string& doc);
/// --html: the result as a page, one file that needs nothing else.
void add_html_option(CLI::App& command, std::string& path);
/// A line that says where the page is; empty where there is none, or where it went to standard output.
std::string note_page(const std::string& path);

/// --json, --html and --quiet of a command, with --out and --force where it fills a folder.
struct OutputOptions {
  std::string folder;
  std::string json;
  std::string html;
  std::string report;  // --report, of commands with a test report
  bool force = false;
  bool quiet = false;

  /// `folder_doc` says what --out is for; without it there is no such option.
  void add_to(CLI::App& command, const char* json_doc, const char* folder_doc = nullptr);
  /// --report, of a command whose Report has make_test_report.
  void add_report_to(CLI::App& command);
  /// Whether nothing is to be printed, since that was asked for or standard output is taken.
  bool is_silent() const { return quiet || json == "-" || html == "-" || report == "-"; }
};

/// The output of one command. To be made before the work, so that what cannot be written is refused before it. Files
/// and folders are made and written beside their places, all of them, before the first is put there: where one fails,
/// none is.
class Output {
 public:
  /// `folders` are those beside --out that the command fills. Throws InputError as OutputFolder and OutputFiles do, and
  /// where two of all files and folders go to one place.
  explicit Output(const OutputOptions& options, std::vector<OutputFile> folders = {});

  /// Throws InputError where a file to be written has been read; stage() does so as well.
  void require_no_input() const { files_.require_no_input(); }
  /// Makes and stages the files for --out, the JSON for --json, the page for --html, the test report for --report, as
  /// far as they are wanted. Throws InputError, RunFailure.
  void stage(const Report& report);
  /// Stages files of a further folder, which must outlive this.
  void stage(OutputFolder& folder, const FolderFiles& files);
  /// Puts all that is staged in its place, prints `text` as commit_all() does, where the files are, and `notes`; where
  /// is_silent(), nothing is printed. Throws Interrupted before the first is put there, InputError.
  void finish(const std::string& text, const std::string& notes = "");
  /// The same without a word on where it is, which is the caller's to say.
  void commit(const std::string& text);
  /// All of a report.
  void show(const Report& report) {
    stage(report);
    finish(report.text);
  }

 private:
  const OutputOptions& options_;
  std::optional<OutputFolder> folder_;
  OutputFiles files_;
  std::vector<std::string> written_;  // names in the folder; a folder in it stands for its files
  std::vector<OutputFolder*> staged_folders_;
  std::vector<StagedOutput> staged_files_;
};

/// Puts files and folders in their places, and prints `text`. First comes what goes to a device, which may be full,
/// then what goes to standard output, so that no result is told which cannot be written; then the folders, whose names
/// another program may have taken meanwhile. Throws Interrupted before all of them, InputError.
void commit_all(std::vector<StagedOutput>& files, const std::vector<OutputFolder*>& folders = {},
                const std::string& text = "");

/// On standard error, folders in a folder of sets that hold CSV files but no set.toml.
void warn_of_undescribed(const std::string& folder);

}  // namespace rollrig::cli
