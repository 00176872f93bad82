#include "api/add_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>

#include "api/option_range.h"
#include "estimation/uncertainty/uncertainty.h"
#include "report/blocks.h"

namespace rollrig {

void check_uncertainty(const UncertaintyOptions& options) {
  require_threads(options.threads);
  estimation::check_trials(options.monte_carlo_trials, "--monte-carlo");
}

bool wants_uncertainty(const UncertaintyOptions& options, bool is_possible) {
  return options.budget || options.monte_carlo_trials > 0 || (options.budget_if_any && is_possible);
}

std::vector<Table> add_uncertainty(const estimation::MeasurementModel& model, const UncertaintyOptions& options,
                                   const Progress& progress, Json& json) {
  const estimation::Uncertainty uncertainty =
      estimation::calc_uncertainty(model, {options.monte_carlo_trials, options.seed, options.threads}, progress);
  json["uncertainty"] = estimation::make_uncertainty_json(uncertainty);
  return estimation::make_uncertainty_tables(uncertainty);
}

namespace {

/// The number as many decimals as a text shows: "5.207" or "5.207 +- 0.037".
std::string show_like(const std::string& text, double value) {
  const std::string first = text.substr(0, text.find(' '));
  const std::size_t point = first.find('.');
  return fmt::format("{:.{}f}", value, point == std::string::npos ? 0 : first.size() - point - 1);
}

/// Puts the value of a tile, which has its uncertainty now, in place of the value as a sentence has it, and what +-
/// means in place of what it meant.
void replace_number(const std::string& shown, const std::string& value, double coverage_factor, Json& sentence) {
  std::string text = sentence.get<std::string>();
  boost::algorithm::replace_first(text, " " + shown + " ", " " + value + " ");
  for (const char* before : {"(k = 2)", "(one standard deviation)", "(one standard error)"}) {
    boost::algorithm::replace_first(text, before, fmt::format("(k = {:.2f})", coverage_factor));
  }
  sentence = text;
}

}  // namespace

void put_budgets_on_tiles(const Json& uncertainty, report::Page& page) {
  const Json& budgets = uncertainty.at("budgets");
  std::vector<report::Block>& blocks = page.sections.front().blocks;
  const auto lead =
      std::find_if(blocks.begin(), blocks.end(), [](const Json& block) { return block.at("type") == "lead"; });
  for (report::Block& block : blocks) {
    if (block.at("type") != "tiles") continue;
    for (Json& tile : block.at("tiles")) {
      if (!tile.contains("from")) continue;
      for (std::size_t i = 0; i < budgets.size(); ++i) {
        const std::string pointer = tile.at("from").front().get<std::string>();
        if (pointer != "/result/" + budgets[i].at("key").get<std::string>()) continue;
        const std::string shown = tile.at("value").get<std::string>();
        tile["value"] = shown.substr(0, shown.find(' ')) + " +- " +
                        show_like(shown, budgets[i].at("expanded_uncertainty").get<double>());
        const double coverage_factor = budgets[i].at("coverage_factor");
        if (lead != blocks.end()) replace_number(shown, tile["value"], coverage_factor, lead->at("text"));
        tile["note"] =
            fmt::format("+- is the expanded uncertainty (k = {:.2f}) of the whole budget, below", coverage_factor);
        tile["from"] = {pointer, fmt::format("/uncertainty/budgets/{}/expanded_uncertainty", i)};
      }
    }
  }
}

std::string make_page_with_uncertainty(report::Page page, const std::vector<Table>& uncertainty) {
  if (!uncertainty.empty()) page.add_behind_first(report::make_section("Uncertainty", uncertainty, {}));
  return report::make_html(page);
}

}  // namespace rollrig
