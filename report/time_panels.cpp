#include "report/run_page.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/quantities.h"
#include "report/blocks.h"
#include "report/readings.h"
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
};

Panel& find_panel(std::vector<Panel>& panels, const Place& place, const std::string& unit) {
  for (Panel& panel : panels) {
    if (panel.label == place.panel && panel.unit == unit) return panel;
  }
  panels.push_back({place.order, place.panel, unit, Json::array()});
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
  std::vector<Panel> panels;
  const std::vector<std::string> positions = list_positions(recording);
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const std::optional<Place> place = find_place(recording.channels[i].quantity, positions);
    if (!place.has_value()) continue;
    const std::string channel = recording.channels[i].quantity.header();
    Panel& panel = find_panel(panels, *place, shown_unit(channel));
    const std::vector<double> values = in_unit_of(channel, recording.values[i]);
    Json series = make_series(place->series, recording.time_s, values);
    series["phases"] = summarize_phases(recording, values);
    if (place->is_read) series["recorded"] = make_recorded(recording.time_s, values);
    panel.series.push_back(std::move(series));
  }
  std::stable_sort(panels.begin(), panels.end(), [](const Panel& a, const Panel& b) { return a.order < b.order; });
  const PageClock view = find_view(recording);
  Block block = {
      {"type", "times"},
      {"view", {view.start_s, view.end_s}},
      {"phases", make_phases(recording.phases)},
      {"rows", make_row_times(recording.time_s)},
      {"panels", Json::array()},
      {"caption",
       "Click on the chart to move the time of slider and animation. The bar below the chart, or Ctrl and the "
       "mouse wheel, zoom."}};
  for (Panel& panel : panels) {
    block["panels"].push_back({{"label", panel.label}, {"unit", panel.unit}, {"series", std::move(panel.series)}});
  }
  return block;
}

}  // namespace rollrig::report
