#include "report/page.h"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>

// The page without its data, page_template.html, is made of report/web (CMakeLists.txt). The assembler takes it in, and
// finds it from the project's root: a literal of that size would take the compiler long.
asm(R"(
  .pushsection .rodata
  .globl rollrig_page_template_begin, rollrig_page_template_end
  .hidden rollrig_page_template_begin, rollrig_page_template_end
rollrig_page_template_begin:
  .incbin "report/page_template.html"
rollrig_page_template_end:
  .popsection
)");

extern "C" {
extern const char rollrig_page_template_begin[];  // NOLINT: a name of the assembler's
extern const char rollrig_page_template_end[];    // NOLINT
}

namespace rollrig::report {
namespace {

Json make_section(const Section& section) {
  Json json = {{"title", section.title}, {"blocks", section.blocks}};
  if (!section.note.empty()) json["note"] = section.note;
  if (!section.folded.empty()) json["folded"] = section.folded;
  return json;
}

/// JSON that can stand inside a script element.
std::string escape_json(const Json& json) {
  // "<" stands in strings alone, so nothing in the text can end the script.
  return boost::algorithm::replace_all_copy(json.dump(-1, ' ', false, Json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace

void Page::add(Section section) {
  if (!section.blocks.empty()) sections.push_back(std::move(section));
}

Json make_payload(const Page& page) {
  Json json = {{"format", "rollrig-page/1"},
               {"command", page.command},
               {"title", page.title},
               {"subtitle", page.subtitle},
               {"about", fmt::format("Made by rollrig {}.", ROLLRIG_VERSION)},
               {"sections", Json::array()}};
  if (page.clock.has_value()) {
    json["clock"] = {{"start_s", page.clock->start_s}, {"end_s", page.clock->end_s}, {"now_s", page.clock->now_s}};
  }
  for (const Section& section : page.sections) json["sections"].push_back(make_section(section));
  return json;
}

std::string make_html(const Page& page) {
  const std::string html(rollrig_page_template_begin, rollrig_page_template_end);
  return boost::algorithm::replace_first_copy(html, "/*PAYLOAD*/", escape_json(make_payload(page)));
}

}  // namespace rollrig::report
