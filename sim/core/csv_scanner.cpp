#include "sim/core/csv_scanner.h"

#include <algorithm>

#include "sim/core/error.h"

namespace rollrig {

CsvScanner::CsvScanner(const std::string& text, const std::string& path, char separator)
    : text_(text), path_(path), ends_{separator, '\n'} {
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // as spreadsheets write it
  if (text_.rfind(kByteOrderMark, 0) == 0) position_ = 3;
}

void CsvScanner::go_to_line(int line) {
  for (; line_ < line && !at_end(); ++line_) position_ = std::min(text_.find('\n', position_), text_.size() - 1) + 1;
}

std::vector<std::string> CsvScanner::next_record() {
  std::vector<std::string> cells;
  bool more = true;
  while (more) cells.push_back(next_cell(more));
  return cells;
}

std::vector<std::string> CsvScanner::next_line() {
  const std::size_t start = position_;
  const int line = line_;
  lines_only_ = true;
  try {
    std::vector<std::string> cells = next_record();
    lines_only_ = false;
    return cells;
  } catch (const InputError&) {
    lines_only_ = false;
    position_ = start;
    line_ = line;
    go_to_line(line + 1);
    throw;
  }
}

std::string CsvScanner::next_cell(bool& more) {
  const bool quoted = !at_end() && text_[position_] == '"';
  std::string cell = quoted ? quoted_content() : std::string();
  const std::size_t end = std::min(text_.find_first_of(ends_, position_), text_.size());
  cell.append(text_, position_, end - position_);
  more = end < text_.size() && text_[end] != '\n';
  if (!more) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    ++line_;
  }
  position_ = end + 1;
  return cell;
}

std::string CsvScanner::quoted_content() {
  const int start_line = line_;
  std::string content;
  for (++position_; !at_end(); ++position_) {
    const char c = text_[position_];
    if (c == '\n') {
      if (lines_only_) break;
      ++line_;
    }
    if (c != '"') {
      content += c;
    } else if (position_ + 1 < text_.size() && text_[position_ + 1] == '"') {
      content += '"';
      ++position_;
    } else {
      ++position_;
      return content;
    }
  }
  throw InputError({"a quoted field never ends", path_, start_line, "", "", "a closing \"", ""});
}

}  // namespace rollrig
