#include "report/test_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "include/rollrig/error.h"
#include "report/blocks.h"
#include "sim/core/embed.h"
#include "sim/core/text.h"
#include "sim/core/units.h"
#include "sim/core/visible.h"

ROLLRIG_EMBED(rollrig_report_style, "report/test_report.css")

namespace rollrig::report {
namespace {

constexpr const char* kByHand = "to be filled in by hand";

/// A cell of the body of a table: numbers stand to the right, and a short word is not broken.
const char* find_cell_class(const ReportCell& cell, bool is_number) {
  constexpr std::size_t kShort = 16;  // Assumed: characters of the longest word that every column has room for
  if (is_number) return "right";
  return count_characters(cell.text) <= kShort ? "short" : "";
}

std::string make_cell_html(const char* tag, const ReportCell& cell, const char* css_class) {
  std::string html = fmt::format("<{}", tag);
  if (*css_class != '\0') html += fmt::format(" class=\"{}\"", css_class);
  if (!cell.place.empty()) html += fmt::format(" data-json=\"{}\"", escape_html(cell.place));
  return html + fmt::format(">{}</{}>", escape_html(cell.text), tag);
}

std::string make_field_row(const ReportField& field) {
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(field.label));
  if (field.values.empty()) return html + fmt::format("<td class=\"blank\">{}</td></tr>\n", kByHand);
  html += "<td>";
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    html += (i == 0 ? "" : " / ") + make_cell_html("span", field.values[i], "");
  }
  if (!field.note.empty()) html += fmt::format(" <span class=\"note\">{}</span>", escape_html(field.note));
  return html + "</td></tr>\n";
}

std::string make_html_of(const ReportForm& form) {
  std::string html = "<table class=\"form\"><tbody>\n";
  for (const ReportField& field : form.fields) html += make_field_row(field);
  return html + "</tbody></table>\n";
}

std::string make_html_of(const ReportText& text) { return fmt::format("<p>{}</p>\n", escape_html(text.text)); }

/// Columns in which every cell is a number, a dash or empty, and one at least a number.
std::vector<bool> find_numbers(const ReportTable& table) {
  std::vector<bool> are(table.columns.size(), false);
  for (std::size_t column = 0; column < are.size(); ++column) {
    bool has_text = false;
    for (const auto& row : table.rows) {
      const std::string& text = row[column].text;
      if (parse_number(text).has_value()) are[column] = true;
      if (!text.empty() && text != "-" && text != "inf" && !parse_number(text).has_value()) has_text = true;
    }
    if (has_text) are[column] = false;
  }
  return are;
}

std::string make_row(const std::vector<ReportCell>& row, const std::vector<bool>& numbers, const std::string& mark) {
  std::string html = mark.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", mark);
  for (std::size_t i = 0; i < row.size(); ++i)
    html += make_cell_html("td", row[i], find_cell_class(row[i], numbers[i]));
  return html + "</tr>\n";
}

std::string make_html_of(const ReportTable& table) {
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size()) throw std::logic_error("a row of '" + table.title + "' is no row of it");
  }
  const std::vector<bool> numbers = find_numbers(table);
  std::string html = "<table>\n";
  const auto is_empty = [](const std::string& column) { return column.empty(); };
  const bool has_head = !std::all_of(table.columns.begin(), table.columns.end(), is_empty);
  if (!table.title.empty() && !has_head) html += fmt::format("<caption>{}</caption>\n", escape_html(table.title));
  if (has_head) {
    html += "<thead>";
    // In the head, which print repeats: a table that continues on the next page has its name there.
    if (!table.title.empty()) {
      html += fmt::format("<tr class=\"title\"><th colspan=\"{}\">{}</th></tr>\n", table.columns.size(),
                          escape_html(table.title));
    }
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      html += make_cell_html("th", {table.columns[i]}, numbers[i] ? "right" : "");
    }
    html += "</tr></thead>\n";
  }
  html += "<tbody>\n";
  const std::size_t first_total = table.rows.size() - std::min(table.totals, table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    html += make_row(table.rows[i], numbers, i < first_total ? "" : i == first_total ? "total first" : "total");
  }
  return html + "</tbody></table>\n";
}

/// Whether a part is short enough to stay whole on a page with the heading above it.
bool is_short(const ReportSection& section) {
  const auto count = [](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_same_v<Part, ReportForm>) return part.fields.size();
    if constexpr (std::is_same_v<Part, ReportTable>) return part.rows.size() + 2;
    return std::size_t{2};
  };
  constexpr std::size_t kShort = 10;  // Assumed: a fifth of a page of A4
  std::size_t lines = 0;
  for (const auto& part : section.parts) lines += std::visit(count, part);
  return lines <= kShort;
}

std::string make_section_html(const ReportSection& section) {
  std::string html = fmt::format("<section{}>\n<h2>{}</h2>\n", is_short(section) ? " class=\"start\"" : "",
                                 escape_html(section.title));
  for (const auto& part : section.parts) {
    html += std::visit([](const auto& own) { return make_html_of(own); }, part);
  }
  return html + "</section>\n";
}

std::string make_files_html(const std::vector<ReportFile>& files) {
  std::string html =
      "<section>\n<h2>Input files</h2>\n<table class=\"files\">\n<thead><tr><th>role</th><th>file</th>"
      "<th>SHA-256</th></tr></thead>\n<tbody>\n";
  for (const ReportFile& file : files) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", escape_html(file.role),
                        escape_html(file.path), escape_html(file.sha256));
  }
  return html + "</tbody></table>\n</section>\n";
}

constexpr const char* kSignatures =
    "<section class=\"start\">\n<h2>Signatures</h2>\n<table class=\"signatures\">\n<thead><tr><th></th><th>Name</th>"
    "<th>Date</th><th>Signature</th></tr></thead>\n<tbody>\n"
    "<tr><th scope=\"row\">Carried out by</th><td></td><td></td><td></td></tr>\n"
    "<tr><th scope=\"row\">Approved by</th><td></td><td></td><td></td></tr>\n</tbody></table>\n</section>\n";

std::string make_head_html(const TestReport& report) {
  std::string html = fmt::format("<header>\n<p class=\"brand\">rollrig</p>\n<h1>{}</h1>\n<p class=\"subject\">{}</p>\n",
                                 escape_html(report.title), escape_html(report.subject));
  html += fmt::format("<p class=\"standard\">{}</p>\n</header>\n", escape_html(report.standard));
  if (report.is_simulated) {
    html +=
        "<p class=\"simulated\">All values of this report come from a simulation. No tire and no vehicle was "
        "tested.</p>\n";
  }
  if (report.warnings.empty()) return html;
  html += "<ul class=\"warnings\">\n";
  for (const std::string& warning : report.warnings) html += fmt::format("<li>{}</li>\n", escape_html(warning));
  return html + "</ul>\n";
}

ReportForm make_origin(const TestReport& report, const std::string& date) {
  ReportForm form{{make_field("Date of this report", date), make_field("Program", "rollrig " ROLLRIG_VERSION)}};
  form.fields.insert(form.fields.end(), report.origin.begin(), report.origin.end());
  return form;
}

}  // namespace

std::string escape_html(const std::string& text) {
  std::string html = show_on_one_line(text);
  for (const auto& [from, to] :
       {std::pair{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}}) {
    boost::algorithm::replace_all(html, from, to);
  }
  return html;
}

bool ReportValues::has(const std::string& place) const { return find(place) != nullptr; }

const Json* ReportValues::find(const std::string& place) const {
  const Json::json_pointer pointer(place);
  if (!json_.contains(pointer)) return nullptr;
  const Json& value = json_.at(pointer);
  return value.is_null() ? nullptr : &value;
}

ReportCell ReportValues::number(const std::string& place, const char* digits) const {
  const Json* value = find(place);
  if (value == nullptr) return {};
  if (value->is_string()) return {value->get<std::string>(), place};
  if (value->is_boolean()) return {value->get<bool>() ? "yes" : "no", place};
  if (value->is_number_integer()) return {value->dump(), place};
  return {fmt::format(fmt::runtime(fmt::format("{{:{}}}", digits)), value->get<double>()), place};
}

ReportCell ReportValues::value(const std::string& place, const char* digits) const {
  ReportCell cell = number(place, digits);
  const std::string unit = shown_unit(place.substr(place.rfind('/') + 1));
  const Json* value = find(place);
  if (value != nullptr && value->is_number() && !unit.empty()) cell.text += " " + unit;
  return cell;
}

ReportField ReportValues::field(const std::string& label, const std::string& place, const char* digits) const {
  if (!has(place)) return {label, {{"-"}}};
  return {label, {value(place, digits)}};
}

ReportField make_field(const std::string& label, const std::string& text) { return {label, {{text}}}; }

ReportField make_blank(const std::string& label) { return {label, {}}; }

ReportTable make_json_table(const ReportValues& values, const std::string& title, const std::string& place,
                            const std::vector<std::pair<const char*, const char*>>& columns, const char* digits) {
  ReportTable table{title, {}, {}, 0};
  for (const auto& [key, heading] : columns) table.columns.push_back(heading);
  const Json& list = values.json().at(Json::json_pointer(place));
  for (std::size_t i = 0; i < list.size(); ++i) {
    table.rows.emplace_back();
    for (const auto& [key, heading] : columns) {
      table.rows.back().push_back(values.number(fmt::format("{}/{}/{}", place, i, key), digits));
    }
  }
  return table;
}

ReportTable make_report_table(const Table& table) {
  ReportTable made{table.title, table.columns, {}, 0};
  if (made.columns.empty() && !table.rows.empty()) made.columns.resize(table.rows.front().size());
  for (const auto& row : table.rows) {
    made.rows.emplace_back();
    for (const std::string& cell : row) made.rows.back().push_back({cell});
  }
  return made;
}

std::string find_report_date() {
  std::time_t now = std::time(nullptr);
  if (const char* given = std::getenv("SOURCE_DATE_EPOCH"); given != nullptr && *given != '\0') {
    const std::optional<double> seconds = parse_number(given);
    constexpr double kMost_s = 253402300799.0;  // the end of the year 9999
    if (!seconds.has_value() || *seconds < 0.0 || *seconds > kMost_s) {
      throw InputError({"the date of the report is not understood", "environment", 0, "SOURCE_DATE_EPOCH", given,
                        "seconds since 1970-01-01, or no such variable", ""});
    }
    now = static_cast<std::time_t>(*seconds);
  }
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(now));
}

std::string make_report_html(const TestReport& report, const std::string& date) {
  const std::string style(rollrig_report_style_begin, rollrig_report_style_end);
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; base-uri "
      "'none'; form-action 'none'\">\n";
  html += fmt::format("<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<div id=\"page\">\n",
                      escape_html(report.title), style);
  html += make_head_html(report);
  for (const ReportSection& section : report.sections) html += make_section_html(section);
  html += make_section_html({"Origin of the values", {make_origin(report, date)}});
  html += make_files_html(report.files);
  html += kSignatures;
  html += fmt::format("<footer>Made by rollrig {} on {}. Lines that say \"{}\" are for the laboratory.</footer>\n",
                      ROLLRIG_VERSION, date, kByHand);
  return html + "</div>\n</body>\n</html>\n";
}

}  // namespace rollrig::report
