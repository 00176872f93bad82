#include "report/page.h"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>

#include "sim/core/embed.h"

// The page without its data, made of report/web (CMakeLists.txt).
ROLLRIG_EMBED(rollrig_page_template, "report/page_template.html")

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

void Page::add_behind_first(Section section) {
  if (section.blocks.empty()) return;
  sections.insert(sections.empty() ? sections.end() : sections.begin() + 1, std::move(section));
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
