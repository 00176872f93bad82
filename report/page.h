#pragma once
/// A page: a title and sections of blocks, each drawn by the function of its type in report/web/src/main.js.

#include <optional>
#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::report {

/// A block is a JSON object with its `type`.
using Block = Json;

struct Section {
  std::string title;
  std::string note = {};  // a sentence below the title
  std::vector<Block> blocks = {};
  std::string folded = {};  // where not empty, the line behind which the blocks are folded away
};

/// The time that slider, charts and animation share.
struct PageClock {
  double start_s = 0.0;
  double end_s = 0.0;
  double now_s = 0.0;
};

struct Page {
  std::string command;
  std::string title;
  std::string subtitle;
  std::vector<Section> sections = {};
  std::optional<PageClock> clock = {};  // of a page with a run over time

  /// Adds a section, unless it would be empty.
  void add(Section section);
  /// The same behind the first section: the result, as a rule.
  void add_behind_first(Section section);
};

/// What the script of a page draws: format, command, title, subtitle, about, clock, sections.
Json make_payload(const Page& page);

/// The page as one file of HTML that needs nothing else.
/// Checked  tests/report/page_test.cpp, tests/report/browser_test.cpp
std::string make_html(const Page& page);

}  // namespace rollrig::report
