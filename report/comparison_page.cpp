#include "report/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "comparison/comparison_json.h"
#include "report/blocks.h"
#include "report/readings.h"
#include "report/time_scale.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using comparison::Overlay;
using comparison::OverlayLine;
using comparison::OverlayPanel;

std::string show_value(const std::optional<double>& value, const char* digits = "{:.5g}") {
  return value.has_value() ? fmt::format(fmt::runtime(digits), *value) : "-";
}

std::string show_limits(const Difference& difference) {
  if (!difference.sd.has_value()) return "-";
  return comparison::show_interval(difference);
}

std::string explain_missing(const EnergyWaterfall& waterfall) {
  return waterfall.missing.empty() ? ""
                                   : fmt::format(" Terms that one of the two does not have count as 0: {}.",
                                                 fmt::join(waterfall.missing, ", "));
}

Block make_waterfall_block(const Comparison& comparison, const EnergyWaterfall& waterfall) {
  constexpr double kPerJ = 1e-3;
  const std::string term = plain_name(waterfall.term);
  const auto make_end = [&term](const std::string& name, double energy_J) {
    return WaterfallBar{fmt::format("{}, {}", term, name), kPerJ * energy_J};
  };
  std::vector<WaterfallBar> steps;
  for (const EnergyStep& step : list_shown_steps(waterfall)) steps.push_back({step.name, kPerJ * step.energy_J});
  return make_waterfall({"Energy", "kJ"}, make_end(comparison.names.front(), waterfall.start_J), steps,
                        make_end(waterfall.compared, waterfall.end_J),
                        fmt::format("Energy of the {} of {}, how much more goes into each term of the energy audit of "
                                    "{}, and its energy.{}",
                                    term, comparison.names.front(), waterfall.compared, explain_missing(waterfall)));
}

/// The main value of each, with its difference from that of the reference.
Block make_main_tiles(const Comparison& comparison, std::size_t main) {
  const ComparedValue& value = comparison.values.at(main);
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < comparison.names.size(); ++i) {
    Tile tile{comparison.names[i],
              show_value(value.values[i]),
              value.unit,
              capitalized(value.label) + (i == 0 ? ", the reference" : ""),
              "",
              {fmt::format("/values/{}/values/{}", main, i)}};
    if (i > 0) {
      const Difference& difference = value.differences[i - 1];
      tile.note =
          fmt::format("{} {} to {}", comparison::show_difference(difference), value.unit, comparison.names.front());
      if (difference.percent.has_value()) tile.note += fmt::format(", {:+.1f} %", *difference.percent);
      if (difference.sd.has_value()) tile.note += fmt::format("; 95 % interval {}", show_limits(difference));
      if (!comparison::shows_difference(difference)) {
        tile.note += ": no difference is shown";
        tile.tone = "doubt";
      }
    }
    tiles.push_back(std::move(tile));
  }
  return make_tiles(tiles);
}

/// Whether a result is a condition of the test rather than what it found.
bool is_condition(const ComparedValue& value) {
  static const std::set<std::string> kConditions{
      "load_N", "speed_km_h", "skim_load_N", "pressure_set_kPa", "pressure_verified_kPa", "ambient_degC"};
  return kConditions.count(value.name) > 0;
}

/// Whether two values differ by the same share in each of the compared, as far as is seen: one is the other times a
/// constant, as a force is a torque over the radius of the drum, or found by another method.
bool differ_alike(const ComparedValue& a, const ComparedValue& b) {
  constexpr double kSame = 2e-3;  // of the percentage: bars that no eye tells apart
  return std::equal(a.differences.begin(), a.differences.end(), b.differences.begin(), b.differences.end(),
                    [](const Difference& x, const Difference& y) {
                      if (x.percent.has_value() != y.percent.has_value()) return false;
                      return !x.percent.has_value() ||
                             std::abs(*x.percent - *y.percent) <= kSame * std::abs(*x.percent);
                    });
}

/// Values whose differences have a bar: no conditions of the test, nothing twice; the main value first, then those with
/// an interval, then those that differ most.
std::vector<const ComparedValue*> choose_bars(const Comparison& comparison, const std::optional<std::size_t>& main) {
  constexpr std::size_t kMost = 10;  // as many have room
  std::vector<const ComparedValue*> candidates;
  for (const ComparedValue& value : comparison.values) {
    const bool is_of_list = value.name.find('.') != std::string::npos;  // or a number of a tire file
    const bool is_uncertainty = value.name.find("uncertainty") != std::string::npos;
    const bool is_main = main.has_value() && &value == &comparison.values[*main];
    if (!value.differences.front().percent.has_value()) continue;
    if (!is_main && (value.unit == "s" || is_of_list || is_uncertainty)) continue;
    if (*value.differences.front().percent == 0.0 || is_condition(value)) continue;
    candidates.push_back(&value);
  }
  // Of values that are told by one bar, it is that of the main value, else of the first with an interval.
  const ComparedValue* main_value = main.has_value() ? &comparison.values[*main] : nullptr;
  const auto has_interval = [](const ComparedValue* value) { return value->differences.front().sd.has_value(); };
  std::stable_partition(candidates.begin(), candidates.end(), has_interval);
  std::stable_partition(candidates.begin(), candidates.end(),
                        [&](const ComparedValue* one) { return one == main_value; });
  std::vector<const ComparedValue*> chosen;
  for (const ComparedValue* value : candidates) {
    const bool is_known = std::any_of(chosen.begin(), chosen.end(),
                                      [value](const ComparedValue* one) { return differ_alike(*one, *value); });
    if (!is_known) chosen.push_back(value);
  }
  const auto weigh = [&](const ComparedValue* value) {
    return std::tuple(value == main_value, has_interval(value), std::abs(*value->differences.front().percent));
  };
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](const ComparedValue* a, const ComparedValue* b) { return weigh(a) > weigh(b); });
  chosen.resize(std::min(chosen.size(), kMost));
  return chosen;
}

Block make_difference_bars(const Comparison& comparison, const std::vector<const ComparedValue*>& chosen) {
  Json categories = Json::array();
  for (const ComparedValue* value : chosen) {
    categories.push_back(capitalized(value->label) +
                         (value->place.empty() ? "" : ", " + comparison::label_place(value->place)));
  }
  Json series = Json::array();
  for (std::size_t other = 1; other < comparison.names.size(); ++other) {
    Json values = Json::array(), low = Json::array(), high = Json::array();
    for (const ComparedValue* value : chosen) {
      const Difference& difference = value->differences[other - 1];
      const bool has_interval = difference.sd.has_value() && difference.percent.has_value();
      const double per_unit = has_interval ? 100.0 / std::abs(*value->values.front()) : 0.0;
      values.push_back(difference.percent.has_value() ? rounded(*difference.percent) : Json());
      low.push_back(has_interval ? rounded(per_unit * *difference.low_95) : Json());
      high.push_back(has_interval ? rounded(per_unit * *difference.high_95) : Json());
    }
    series.push_back({{"name", comparison.names[other]}, {"values", values}, {"low", low}, {"high", high}});
  }
  return make_bars(
      {fmt::format("Difference from {}", comparison.names.front()), "%"}, categories, series,
      "Whiskers are intervals of 95 %; where there is none, none is known. Of values that differ by the same "
      "share, one has a bar.");
}

/// So many points of a line that a page with all of them stays small.
std::size_t find_most_points(const std::vector<Overlay>& overlays) {
  constexpr std::size_t kAll = 60000, kFewest = 200, kMost = 2000;
  std::size_t lines = 0;
  for (const Overlay& overlay : overlays) {
    for (const OverlayPanel& panel : overlay.panels) lines += panel.lines.size();
  }
  return std::clamp(kAll / std::max<std::size_t>(lines, 1), kFewest, kMost);
}

Json make_overlay_series(const std::string& name, const OverlayLine& line, std::size_t most) {
  constexpr double kShownShare = 1e-6;  // less than the digits that are written
  double size = 0.0;
  for (const double value : line.values) size = std::isfinite(value) ? std::max(size, std::abs(value)) : size;
  Json t = Json::array(), y = Json::array();
  const DrawnRows rows = hold_to_jumps(line.time_s, line.values);
  for (const std::size_t row : thin(rows.time_s, rows.values, most, kShownShare * size)) {
    t.push_back(std::round(1e3 * rows.time_s[row]) / 1e3);
    y.push_back(rounded(rows.values[row]));
  }
  return {{"name", name}, {"t", t}, {"y", y}};
}

/// Of each run which rows set the scale; empty where the overlay is not of a drum.
std::vector<std::vector<bool>> find_overlay_rows(const Overlay& overlay) {
  const auto find = [&overlay](const char* channel) -> const OverlayPanel* {
    for (const OverlayPanel& panel : overlay.panels) {
      if (panel.channel == channel) return &panel;
    }
    return nullptr;
  };
  const OverlayPanel* load = find("load_N");
  const OverlayPanel* speed = find("speed_km_h");
  std::vector<std::vector<bool>> counts;
  if (load == nullptr || speed == nullptr || find("drum_torque_Nm") == nullptr) return counts;
  for (std::size_t i = 0; i < load->lines.size(); ++i) {
    std::vector<double> speed_m_s = speed->lines[i].values;
    for (double& value : speed_m_s) value /= kKmhPerMs;
    counts.push_back(find_scale_rows(load->lines[i].time_s, load->lines[i].values, speed_m_s));
  }
  return counts;
}

Block make_overlay_block(const Comparison& comparison, const Overlay& overlay, std::size_t most) {
  Json phases = Json::array();
  std::vector<std::pair<double, double>> spans_s;
  for (const comparison::OverlayPhase& phase : overlay.phases) {
    spans_s.emplace_back(phase.start_s, phase.end_s);
    phases.push_back({{"name", phase.name}, {"start_s", rounded(phase.start_s)}, {"end_s", rounded(phase.end_s)}});
  }
  const std::vector<std::vector<bool>> counts = find_overlay_rows(overlay);
  Json panels = Json::array();
  double end_s = overlay.view_start_s;
  for (const OverlayPanel& panel : overlay.panels) {
    Json series = Json::array();
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      series.push_back(make_overlay_series(comparison.names[i], panel.lines[i], most));
      if (!spans_s.empty()) {
        series.back()["phases"] = summarize_spans(panel.lines[i].time_s, panel.lines[i].values, spans_s);
      }
      if (!panel.lines[i].time_s.empty()) end_s = std::max(end_s, panel.lines[i].time_s.back());
    }
    panels.push_back(
        {{"label", capitalized(plain_name(panel.channel))}, {"unit", shown_unit(panel.channel)}, {"series", series}});
    std::vector<ScaledLine> lines;
    for (std::size_t i = 0; i < counts.size(); ++i) lines.emplace_back(&panel.lines[i].values, &counts[i]);
    if (const Json scale = find_scale(lines); !scale.is_null()) panels.back()["scale"] = scale;
  }
  Block block = {{"type", "times"},
                 {"unlinked", true},
                 {"phases", phases},
                 {"view", {rounded(overlay.view_start_s), rounded(end_s)}},
                 {"panels", panels},
                 {"caption",
                  "Each phase begins at one time for all. The bar below the chart, or "
                  "Ctrl and the mouse wheel, zoom."}};
  if (!overlay.title.empty()) block["title"] = overlay.title;
  return block;
}

/// The table of the terminal, whose keys options and files take, with names in place of the keys.
Table make_named_inputs(const Comparison& comparison) {
  Table table = make_comparison_input_table(comparison);
  for (std::vector<std::string>& row : table.rows) row.front() = comparison::label_input(row.front());
  return table;
}

/// Conditions of the test that are not the same for all: "The tests differ in load: a40 5570 N, a50 6865 N." Empty
/// where none differs.
std::string describe_conditions(const Comparison& comparison, const std::optional<std::size_t>& main) {
  constexpr double kSame = 1e-3;  // of the value: less is how well a controller holds it
  if (!main.has_value()) return "";
  std::vector<std::string> texts;
  for (const ComparedValue& value : comparison.values) {
    if (!is_condition(value) || value.place != comparison.values[*main].place) continue;
    const std::optional<double>& reference = value.values.front();
    const bool differs = std::any_of(value.differences.begin(), value.differences.end(), [&](const Difference& one) {
      return one.value.has_value() && std::abs(*one.value) > kSame * std::abs(reference.value_or(0.0));
    });
    if (!differs) continue;
    std::vector<std::string> each;
    for (std::size_t i = 0; i < value.values.size(); ++i) {
      each.push_back(fmt::format("{} {} {}", comparison.names[i], show_value(value.values[i], "{:.4g}"), value.unit));
    }
    texts.push_back(fmt::format("{}: {}", value.label, fmt::join(each, ", ")));
  }
  return texts.empty() ? "" : fmt::format("The tests differ in their {}.", fmt::join(texts, "; "));
}

Block make_list_block(const std::vector<std::string>& items) { return {{"type", "text"}, {"items", items}}; }

}  // namespace

Page make_comparison_page(const comparison::Compared& compared) {
  const Comparison& comparison = compared.comparison;
  Page page{"compare", fmt::format("Comparison of {}", comparison::name_of(comparison.kind)),
            fmt::format("{}. The first is the reference.", fmt::join(comparison.names, ", "))};
  Section top{"Main difference"};
  if (!comparison.message.empty()) {
    top.blocks.push_back(make_lead("", comparison.message + ".", describe_conditions(comparison, compared.main)));
  }
  if (compared.main.has_value()) {
    top.blocks.push_back(make_main_tiles(comparison, *compared.main));
  }
  if (!comparison.warnings.empty()) top.blocks.push_back(make_warnings(comparison.warnings));
  const std::vector<const ComparedValue*> bars = choose_bars(comparison, compared.main);
  if (!bars.empty()) top.blocks.push_back(make_difference_bars(comparison, bars));
  page.add(std::move(top));
  page.add({"Inputs",
            "",
            {comparison.inputs.empty() ? make_paragraph("All inputs are the same.")
                                       : make_table(make_named_inputs(comparison))}});
  Section energy{"Energy"};
  for (const EnergyWaterfall& waterfall : comparison.waterfalls) {
    energy.blocks.push_back(make_waterfall_block(comparison, waterfall));
  }
  page.add(std::move(energy));
  Section times{"Over time"};
  const std::size_t most = find_most_points(compared.overlays);
  for (const Overlay& overlay : compared.overlays) {
    times.blocks.push_back(make_overlay_block(comparison, overlay, most));
  }
  page.add(std::move(times));
  page.add(make_section("All differences", make_comparison_difference_tables(comparison), {}));
  std::vector<std::string> method = comparison.method;
  for (std::string& reason : list_interval_reasons(comparison)) method.push_back(std::move(reason));
  page.add({"How intervals are found", "", {make_list_block(method)}});
  return page;
}

}  // namespace rollrig::report
