#include "report/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/quantities.h"
#include "report/blocks.h"
#include "report/readings.h"
#include "report/time_scale.h"
#include "rigs/vehicle_channels.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

namespace quantities = models::quantities;

/// In the order of their panels. Of what is not listed a machine's force stands with the drum's torque, a temperature
/// with the others; the rest comes last.
constexpr Quantity kOrder[]{quantities::kSpeed,
                            quantities::kLoad,
                            quantities::kContactLoad,
                            quantities::kDrumTorque,
                            quantities::kTractionForce,
                            quantities::kLongitudinalForce,
                            quantities::kLossForce,
                            quantities::kRollingResistance,
                            quantities::kParasiticLoss,
                            quantities::kSpindleForce,
                            quantities::kLinerTemperature,
                            quantities::kGasTemperature,
                            quantities::kSurfaceTemperature,
                            quantities::kAmbient,
                            quantities::kCavityPressure};

/// Most quantities have a panel of their own.
std::string find_panel_name(const Quantity& quantity) {
  if (quantity == quantities::kContactLoad) return "Load";
  for (const Quantity& loss : {quantities::kLossForce, quantities::kRollingResistance, quantities::kParasiticLoss}) {
    if (quantity == loss) return "Loss";
  }
  return quantity.unit_suffix() == "degC" ? "Temperature" : capitalized(plain_name(quantity.header()));
}

/// Positions of the wheels ("front_left"), of which each has a load of its own; none where there is one wheel.
std::vector<std::string> list_positions(const sim::Recording<double>& recording) {
  std::vector<std::string> positions;
  for (const sim::Channel& channel : recording.channels) {
    const std::string_view prefix = "load_";
    const std::string_view name = channel.quantity.name();
    if (name.rfind(prefix, 0) == 0) positions.emplace_back(name.substr(prefix.size()));
  }
  return positions;
}

struct Place {
  const Quantity* order;  // in kOrder
  std::string panel;
  std::string series;
  bool is_read = true;  // the page shows its value at the time of the slider
};

/// Panel and name of a channel. With several wheels a panel holds one quantity, a line a wheel; their loads, which stay
/// as they are on a vehicle, have none: what their contacts carry says more.
std::optional<Place> find_place(const Quantity& channel, const std::vector<std::string>& positions) {
  const auto find_order = [](const Quantity& quantity) {
    const auto listed = std::find(std::begin(kOrder), std::end(kOrder), quantity);
    if (listed != std::end(kOrder) || !rigs::is_force(quantity)) return listed;
    return std::find(std::begin(kOrder), std::end(kOrder), quantities::kDrumTorque);
  };
  for (const std::string& position : positions) {
    const std::optional<Quantity> own = rigs::without_position(channel, position);
    if (!own.has_value()) continue;
    if (*own == quantities::kLoad) return std::nullopt;
    return Place{find_order(*own), capitalized(plain_name(own->header())), plain_name(position),
                 position == positions.front()};
  }
  const bool is_further_temperature = find_order(channel) == std::end(kOrder) && channel.unit_suffix() == "degC";
  return Place{is_further_temperature ? find_order(quantities::kAmbient) : find_order(channel),
               find_panel_name(channel), plain_name(channel.header())};
}

struct Panel {
  const Quantity* order;
  std::string label;
  std::string unit;
  Json series = Json::array();
  std::vector<std::vector<double>> values = {};  // of each series
};

bool is_all_zero(const Panel& panel) {
  return std::all_of(panel.values.begin(), panel.values.end(), [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
  });
}

/// Whether two panels of one unit show the same lines.
bool are_same(const Panel& a, const Panel& b) {
  constexpr double kSame = 1e-6;  // relative: what six digits show
  if (a.unit != b.unit || a.values.size() != b.values.size()) return false;
  for (std::size_t s = 0; s < a.values.size(); ++s) {
    for (std::size_t i = 0; i < a.values[s].size(); ++i) {
      if (std::abs(a.values[s][i] - b.values[s][i]) > kSame * std::abs(a.values[s][i])) return false;
    }
  }
  return true;
}

/// Takes away panels that are zero throughout or as one before. Returns a sentence for each.
std::string drop_empty_panels(std::vector<Panel>& panels) {
  std::string text;
  std::vector<Panel> kept;
  for (Panel& panel : panels) {
    const auto same =
        std::find_if(kept.begin(), kept.end(), [&panel](const Panel& one) { return are_same(one, panel); });
    if (is_all_zero(panel)) {
      text += fmt::format(" {} is 0 throughout.", panel.label);
    } else if (same != kept.end()) {
      text += fmt::format(" {} is the same as {}.", panel.label, plain_name(same->label));
    } else {
      kept.push_back(std::move(panel));
    }
  }
  panels = std::move(kept);
  return text;
}

/// Says which points of a series are no rows; some may have been thinned out.
void add_held_times(const std::vector<double>& held_s, Json& series) {
  for (const double time_s : held_s) {
    const Json time = std::round(1e3 * time_s) / 1e3;  // as make_series() writes it
    if (std::find(series["t"].begin(), series["t"].end(), time) != series["t"].end()) series["held"].push_back(time);
  }
}

Panel& find_panel(std::vector<Panel>& panels, const Place& place, const std::string& unit) {
  for (Panel& panel : panels) {
    if (panel.label == place.panel && panel.unit == unit) return panel;
  }
  panels.push_back({place.order, place.panel, unit});
  return panels.back();
}

}  // namespace

Json make_phases(const std::vector<sim::PhaseSpan>& phases) {
  Json json = Json::array();
  for (const sim::PhaseSpan& phase : phases) {
    json.push_back({{"name", phase.name}, {"start_s", rounded(phase.start_s)}, {"end_s", rounded(phase.end_s)}});
  }
  return json;
}

PageClock find_view(const sim::Recording<double>& recording) {
  constexpr double kRolls_m_s = 0.05;
  constexpr double kBefore_s = 60.0;
  constexpr double kNow = 0.5;  // of what is shown: where the slider stands at first
  PageClock view{recording.time_s.front(), recording.time_s.back(), 0.0};
  const std::vector<double>& speed_m_s = recording.channel(quantities::kSpeed);
  for (std::size_t row = 0; row < speed_m_s.size(); ++row) {
    if (!(std::abs(speed_m_s[row]) > kRolls_m_s)) continue;
    view.start_s = std::max(view.start_s, recording.time_s[row] - kBefore_s);
    break;
  }
  view.now_s = std::round(view.start_s + kNow * (view.end_s - view.start_s));
  return view;
}

Block make_times(const sim::Recording<double>& recording) {
  constexpr std::size_t kPage = 45000;  // points: a page of two hours with four wheels stays below 2 MB
  const std::size_t most_points = std::clamp<std::size_t>(kPage / recording.channels.size(), 400, 2000);
  std::vector<Panel> panels;
  const std::vector<std::string> positions = list_positions(recording);
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const std::optional<Place> place = find_place(recording.channels[i].quantity, positions);
    if (!place.has_value()) continue;
    const std::string channel = recording.channels[i].quantity.header();
    Panel& panel = find_panel(panels, *place, shown_unit(channel));
    const std::vector<double> values = in_unit_of(channel, recording.values[i]);
    const DrawnRows rows = hold_to_jumps(recording.time_s, values);
    Json series = make_series(place->series, rows.time_s, rows.values, most_points);
    add_held_times(rows.held_s, series);
    series["phases"] = summarize_phases(recording, values);
    if (place->is_read) series["recorded"] = make_recorded(recording.time_s, values);
    panel.series.push_back(std::move(series));
    panel.values.push_back(values);
  }
  std::stable_sort(panels.begin(), panels.end(), [](const Panel& a, const Panel& b) { return a.order < b.order; });
  const std::string dropped = drop_empty_panels(panels);
  const bool is_drum = std::any_of(recording.channels.begin(), recording.channels.end(),
                                   [](const auto& channel) { return channel.quantity == quantities::kDrumTorque; });
  const std::vector<bool> counts = is_drum ? find_scale_rows(recording.time_s, recording.channel(quantities::kLoad),
                                                             recording.channel(quantities::kSpeed))
                                           : std::vector<bool>{};
  const PageClock view = find_view(recording);
  Block block = {
      {"type", "times"},
      {"view", {view.start_s, view.end_s}},
      {"phases", make_phases(recording.phases)},
      {"rows", make_row_times(recording.time_s)},
      {"panels", Json::array()},
      {"caption",
       std::string(
           "Click on the chart to move the time of slider and animation. The bar below the chart, or Ctrl and the "
           "mouse wheel, zoom.") +
           dropped}};
  for (Panel& panel : panels) {
    std::vector<ScaledLine> lines;
    for (const std::vector<double>& values : panel.values) lines.emplace_back(&values, &counts);
    const Json scale = is_drum ? find_scale(lines) : Json();
    block["panels"].push_back({{"label", panel.label}, {"unit", panel.unit}, {"series", std::move(panel.series)}});
    if (!scale.is_null()) block["panels"].back()["scale"] = scale;
  }
  return block;
}

}  // namespace rollrig::report
