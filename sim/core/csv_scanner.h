#pragma once
/// The text of a CSV file, record after record.

#include <string>
#include <vector>

namespace rollrig {

/// Splits RFC 4180 text into records.
class CsvScanner {
 public:
  /// Keeps references to `text` and `path`.
  CsvScanner(const std::string& text, const std::string& path, char separator);

  bool at_end() const { return position_ >= text_.size(); }
  /// Line on which the next record starts.
  int line() const { return line_; }

  /// Passes over whole lines, whatever they hold, up to `line`.
  void go_to_line(int line);

  /// The cells of the next record. Throws InputError: a quote that never ends.
  std::vector<std::string> next_record();

  /// As next_record(), of a file in which each record is one line: a quote that does not end on its line is an error,
  /// and the next record is that of the next line.
  std::vector<std::string> next_line();

 private:
  std::string next_cell(bool& more);
  std::string quoted_content();

  const std::string& text_;
  const std::string& path_;
  const std::string ends_;  // of a cell
  bool lines_only_ = false;
  std::size_t position_ = 0;
  int line_ = 1;
};

}  // namespace rollrig
