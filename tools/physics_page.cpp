#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <filesystem>
#include <regex>
#include <sstream>

#include "models/effect.h"
#include "tools/pages.h"

namespace rollrig::tools {
namespace {

namespace fs = std::filesystem;
namespace text = boost::algorithm;

constexpr const char* kAssumed = "Assumed";
const std::vector<std::string> kFolders{"include",      "models",     "rigs",      "sim",
                                        "measurements", "estimation", "scenarios", "diagnosis"};

/// Files of some folders with one of the extensions, by name.
std::vector<std::string> list_files(const std::vector<std::string>& folders,
                                    const std::vector<std::string>& extensions) {
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(kProjectFolder) / folder)) {
      const std::string extension = entry.path().extension().string();
      if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) continue;
      files.push_back(fs::relative(entry.path(), kProjectFolder).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> read_lines(const std::string& file) {
  std::vector<std::string> lines;
  std::istringstream in(read_text_file(fmt::format("{}/{}", kProjectFolder, file)));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What a comment documents: the last word before "(" or "{" of the declaration that follows.
std::string find_name(const std::vector<std::string>& lines, std::size_t line) {
  static const std::regex name("([A-Za-z_0-9:]+)\\s*(\\(|\\{|;|=|:\\s)");
  for (; line < lines.size(); ++line) {
    if (text::starts_with(text::trim_copy(lines[line]), "template")) continue;
    std::smatch found;
    return std::regex_search(lines[line], found, name) ? found[1].str() : text::trim_copy(lines[line]);
  }
  return "";
}

/// Doc comments of a header that state an equation, each under the name of what it documents.
std::string write_equations(const std::string& file) {
  const std::vector<std::string> lines = read_lines(file);
  std::string page;
  std::string comment;
  bool has_equation = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line = text::trim_copy(lines[i]);
    if (text::starts_with(line, "///")) {
      const std::string content = line.substr(3);
      has_equation = has_equation || text::starts_with(text::trim_copy(content), "Equation");
      comment += (content.empty() ? "" : content.substr(1)) + "\n";
      continue;
    }
    if (has_equation) page += fmt::format("##### `{}`\n\n```text\n{}```\n\n", find_name(lines, i), comment);
    comment.clear();
    has_equation = false;
  }
  return page.empty() ? "" : fmt::format("#### {}\n\n{}", file, page);
}

/// What effects or tire models declare of themselves.
template <class Registered>
std::string write_declared(const std::vector<const Registered*>& all) {
  std::string page;
  for (const Registered* one : all) {
    page += fmt::format("* [`{0}`](reference.md#{0}): {1}. {2}.\n\n  Source: {3}.\n\n", one->info.id, one->info.summary,
                        one->info.equation, one->info.source);
  }
  return page;
}

/// A line that says "Assumed", and what goes on of its comment: code before, words after.
std::string write_assumed_row(const std::string& file, const std::vector<std::string>& lines, std::size_t line) {
  const std::size_t at = lines[line].find(kAssumed);
  std::string code = text::trim_copy(lines[line].substr(0, at));
  text::trim_right_if(code, text::is_any_of("/#\" "));
  std::string words =
      text::trim_copy_if(lines[line].substr(at + std::string(kAssumed).size()), text::is_any_of(": \","));
  static const std::regex continued("^\\s*(///?|#|\")\\s*(.*)$");
  static const std::regex next_part("(Equation|Symbols|Validity|Energy|Errors|Accuracy|Checked|Source) ");
  std::smatch more;
  constexpr std::size_t kMost = 4;
  for (std::size_t i = line + 1; i < std::min(lines.size(), line + kMost); ++i) {
    const bool ends = text::ends_with(words, ".") || text::ends_with(words, ";") || text::ends_with(words, "}");
    if (ends || !std::regex_match(lines[i], more, continued) || lines[i].find(kAssumed) != std::string::npos) break;
    if (std::regex_search(more[2].first, lines[i].cend(), next_part, std::regex_constants::match_continuous)) break;
    words += " " + text::trim_copy_if(more[2].str(), text::is_any_of(" \","));
  }
  const std::string shown = code.empty() ? "" : "`" + escape_cell(code) + "`";
  return fmt::format("| {} | {} | {} |", file, shown, escape_cell(words));
}

bool is_in_words(const std::string& line) {
  const auto before = line.substr(0, line.find(kAssumed));
  return std::count(before.begin(), before.end(), '"') % 2 == 1;
}

/// What their sources say that is assumed.
template <class Registered>
void add_declared_assumed(const std::string& folder, const std::vector<const Registered*>& all, Rows& rows) {
  for (const Registered* one : all) {
    const std::size_t at = one->info.source.find("Assumed: ");
    if (at == std::string::npos) continue;
    rows.push_back(fmt::format("| {0}/{1}.cpp | `{1}` | {2} |", folder, one->info.id,
                               escape_cell(one->info.source.substr(at + 9))));
  }
}

Rows list_assumed() {
  Rows rows;
  add_declared_assumed("models/tire", models::all_tire_models(), rows);
  add_declared_assumed("models/effects", models::all_effects(), rows);
  std::vector<std::string> files = list_files(kFolders, {".h", ".cpp"});
  const std::vector<std::string> assets = list_files({"assets"}, {".toml"});
  files.insert(files.end(), assets.begin(), assets.end());
  for (const std::string& file : files) {
    const bool is_declared = text::starts_with(file, "models/effects/") || text::starts_with(file, "models/tire/");
    const std::vector<std::string> lines = read_lines(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].find(kAssumed) == std::string::npos || (is_declared && is_in_words(lines[i]))) continue;
      if (lines[i].find("says \"Assumed:\"") != std::string::npos) continue;  // of a file's other numbers
      rows.push_back(write_assumed_row(file, lines, i));
    }
  }
  return rows;
}

}  // namespace

std::string make_physics_page() {
  std::string equations;
  for (const std::string& file : list_files(kFolders, {".h"})) equations += write_equations(file);
  using fmt::literals::operator""_a;
  return fill_page("physics", "equations"_a = equations, "tire_models"_a = write_declared(models::all_tire_models()),
                   "effects"_a = write_declared(models::all_effects()), "assumed"_a = join(list_assumed()));
}

}  // namespace rollrig::tools
