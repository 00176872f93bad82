#include "report/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/quantities.h"
#include "report/blocks.h"

namespace rollrig::report {
namespace {

Json column(const Json& rows, const char* key) {
  Json values = Json::array();
  for (const Json& row : rows) values.push_back(row.contains(key) ? row[key] : Json(nullptr));
  return values;
}

Json make_bar_series(const std::string& name, const Json& rows, const char* key) {
  return {{"name", name}, {"values", column(rows, key)}};
}

/// The source's figure of a multi-cycle test.
Block make_section_energies(const Json& sections) {
  Json model = make_bar_series("model, tire warming up", sections, "rr_energy_Wh");
  for (const Json& section : sections) {
    model["labels"].push_back(fmt::format("{:+.1f} %", section.value("difference_percent", 0.0)));
  }
  return make_bars({"Energy of rolling resistance, one tire", "Wh"}, column(sections, "name"),
                   {model, make_bar_series("constant ISO coefficient", sections, "rr_energy_iso_Wh")},
                   "Above the bars: how much the model needs more than the coefficient of ISO 28580 says.");
}

Block make_section_temperatures(const Json& sections) {
  return make_bars({"Temperature of the tire's liner", "°C"}, column(sections, "name"),
                   {make_bar_series("at the start of the section", sections, "temperature_start_degC"),
                    make_bar_series("at its end", sections, "temperature_end_degC")});
}

Json make_cycle_names(const Json& cycles) {
  Json names = Json::array();
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    names.push_back(fmt::format("{}: {:.0f} N, {:.0f} km/h", i + 1, cycles[i].value("load_N", 0.0),
                                cycles[i].value("speed_km_h", 0.0)));
  }
  return names;
}

Block make_cycle_forces(const Json& cycles) {
  return make_bars({"Force, mean over the window", "N"}, make_cycle_names(cycles),
                   {make_bar_series("rolling resistance", cycles, "rolling_resistance_N"),
                    make_bar_series("parasitic loss", cycles, "parasitic_N")});
}

Block make_cycle_coefficients(const Json& cycles) {
  return make_bars({"Rolling resistance coefficient", "N/kN"}, make_cycle_names(cycles),
                   Json::array({make_bar_series("RRc", cycles, "rrc_N_per_kN")}));
}

/// Resistance from cycle to cycle, over what differs between them; as bars where several things do.
Block make_cycle_course(const Json& cycles) {
  struct Varied {
    const char* key;
    Axis axis;
  };
  std::vector<Varied> varied;
  for (const Varied& one : {Varied{"load_N", {"Load", "N"}}, Varied{"speed_km_h", {"Speed", "km/h"}},
                            Varied{"pressure_set_kPa", {"Pressure set", "kPa"}}}) {
    constexpr double kSame = 1e-3;
    const double first = cycles.front().value(one.key, 0.0);
    const bool differs = std::any_of(cycles.begin(), cycles.end(), [&](const Json& cycle) {
      return std::abs(cycle.value(one.key, 0.0) - first) > kSame * first;
    });
    if (differs) varied.push_back(one);
  }
  if (varied.size() != 1) return make_cycle_coefficients(cycles);
  std::vector<std::pair<double, double>> points;
  for (const Json& cycle : cycles) {
    points.emplace_back(cycle.value(varied.front().key, 0.0), cycle.value("rrc_N_per_kN", std::nan("")));
  }
  std::sort(points.begin(), points.end());
  ChartSeries line;
  for (const auto& [at, rrc] : points) line.add(at, rrc);
  return make_curves(varied.front().axis, {"Rolling resistance coefficient", "N/kN"},
                     Json::array({line.finish("RRc", "line")}));
}

Json make_curve(const char* name, const Json& rows, const char* x, const char* y) {
  return {{"name", name}, {"kind", "line"}, {"x", column(rows, x)}, {"y", column(rows, y)}};
}

Block make_road_load(const Json& forces) {
  return make_curves({"Speed", "km/h"}, {"Road load", "N", true},
                     Json::array({make_curve("A + B v + C v²", forces, "speed_km_h", "force_N")}));
}

Block make_setting(const Json& differences) {
  return make_curves({"Speed", "km/h"}, {"Road load", "N", true},
                     {make_curve("target, from the road", differences, "speed_km_h", "target_N"),
                      make_curve("found on the rollers", differences, "speed_km_h", "found_N")});
}

/// The points, and the straight line through them down to load zero.
Block make_skim_line(const Json& result, const Json& points) {
  ChartSeries line;
  double largest_N = 0.0;
  for (const Json& point : points) largest_N = std::max(largest_N, point["load_N"].get<double>());
  for (const double load_N : {0.0, largest_N}) {
    line.add(load_N, result["intercept_N"].get<double>() + result["slope_N_per_kN"].get<double>() * load_N / 1e3);
  }
  return make_curves({"Load", "N", true}, {"Force in skim", "N"},
                     Json::array({make_curve("measured", points, "load_N", "force_N"), line.finish("straight line", "line")}),
                     "Where the straight line meets load zero is the loss of the rig alone.");
}

/// Whether all rows have a number; a drive with the measured road load of its vehicle has no loss of its tires.
bool has_numbers(const Json& rows, const char* key) {
  return std::all_of(rows.begin(), rows.end(), [key](const Json& row) {
    const auto at = row.find(key);
    return at != row.end() && at->is_number();
  });
}

/// Rows of a coastdown's phase, as speed over its own time.
struct CoastRun {
  std::string name;
  std::vector<double> time_s;
  std::vector<double> speed_km_h;
};

std::vector<CoastRun> list_coasts(const Json& coastdowns, const sim::Recording<double>& recording) {
  std::vector<CoastRun> runs;
  const std::vector<double> speed_km_h = in_unit_of("speed_km_h", recording.channel(models::quantities::kSpeed));
  for (const Json& coastdown : coastdowns) {
    CoastRun run{coastdown["name"], {}, {}};
    const sim::PhaseSpan& phase = recording.phase_named(run.name);
    for (std::size_t row = recording.row_at(phase.start_s);
         row < recording.time_s.size() && recording.time_s[row] <= phase.end_s; ++row) {
      run.time_s.push_back(recording.time_s[row] - phase.start_s);
      run.speed_km_h.push_back(speed_km_h[row]);
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

Block make_coast_chart(const std::vector<CoastRun>& runs) {
  constexpr std::size_t kMost = 300;  // points of a line: more than it has bends
  Json series = Json::array();
  for (const CoastRun& run : runs) {
    ChartSeries line;
    for (const std::size_t row : thin(run.time_s, run.speed_km_h, kMost))
      line.add(run.time_s[row], run.speed_km_h[row]);
    series.push_back(line.finish(run.name, "line"));
  }
  return make_curves({"Time since the start of the coastdown", "s"}, {"Speed", "km/h", true}, series);
}

/// Where the values of a sum lead, part by part.
Block make_parts(const WaterfallBar& start, const WaterfallBar& part, const WaterfallBar& end) {
  return make_waterfall({"Force at the surface", "N"}, start, {part}, end);
}

/// Rolling resistance over the time under load; none where no channel has it, or nothing is loaded.
std::optional<Block> make_loss_course(const sim::Recording<double>& recording) {
  constexpr double kLoaded = 0.5;     // of the largest load
  constexpr std::size_t kMost = 600;  // points of a line: more than it has bends
  constexpr double kPerMin = 1.0 / 60.0;
  const auto find = [&recording](const Quantity& quantity) -> const std::vector<double>* {
    for (std::size_t i = 0; i < recording.channels.size(); ++i) {
      const std::string_view name = recording.channels[i].quantity.name();
      if (name.rfind(quantity.name(), 0) == 0) return &recording.values[i];  // of a vehicle, the first wheel
    }
    return nullptr;
  };
  const std::vector<double>* loss_N = find(models::quantities::kRollingResistance);
  const std::vector<double>* load_N = find(models::quantities::kLoad);
  if (loss_N == nullptr || load_N == nullptr) return std::nullopt;
  const double most_N = *std::max_element(load_N->begin(), load_N->end());
  const std::vector<double>& speed_m_s = recording.channel(models::quantities::kSpeed);
  std::vector<double> time_min, shown_N;
  double start_s = 0.0;
  for (std::size_t row = 1; row < loss_N->size(); ++row) {
    const bool is_loaded = (*load_N)[row] > kLoaded * most_N && std::abs(speed_m_s[row]) > 0.05;
    const bool was_loaded =
        (*load_N)[row - 1] > kLoaded * most_N;  // the first row under load is a mean across its start
    if (!is_loaded && shown_N.empty()) continue;
    if (shown_N.empty()) start_s = recording.time_s[row];
    time_min.push_back(kPerMin * (recording.time_s[row] - start_s));
    shown_N.push_back(is_loaded && was_loaded ? (*loss_N)[row] : std::nan(""));
  }
  if (shown_N.empty()) return std::nullopt;
  ChartSeries line;
  for (const std::size_t row : thin(time_min, shown_N, kMost)) line.add(time_min[row], shown_N[row]);
  return make_curves({"Time under load", "min"}, {"Rolling resistance", "N"},
                     Json::array({line.finish("rolling resistance", "line")}));
}

}  // namespace

std::optional<Block> make_first_figure(const Json& result, const sim::Recording<double>& recording) {
  const auto list = [&result](const char* key) {
    const Json rows = result.value(key, Json::array());
    return rows.is_array() ? rows : Json::array();
  };
  const auto number = [&result](const char* key) { return result.at(key).get<double>(); };
  if (!list("force_N").empty()) return make_road_load(list("force_N"));
  if (!list("differences").empty()) return make_setting(list("differences"));
  if (!list("points").empty()) return make_skim_line(result, list("points"));
  const Json sections = list("sections");
  if (!sections.empty() && has_numbers(sections, "difference_percent")) return make_section_energies(sections);
  if (list("cycles").size() > 1 && !result.contains("rrc_25degC_2m_N_per_kN")) {
    return make_cycle_course(list("cycles"));
  }
  if (result.contains("rrc_25degC_2m_N_per_kN")) {
    const double loss_N = number("rolling_resistance_N"), parasitic_N = number("parasitic_N");
    return make_parts({"measured under load", loss_N + parasitic_N}, {"parasitic loss, by the skim test", -parasitic_N},
                      {"rolling resistance", loss_N});
  }
  if (result.contains("rig_alone_N") && result.contains("tire_share_N")) {
    const double rig_N = number("rig_alone_N"), tire_N = number("tire_share_N");
    return make_parts({"the rig alone", rig_N}, {"the tire, at the skim load", tire_N},
                      {"measured in the skim test", rig_N + tire_N});
  }
  return make_loss_course(recording);
}

Section make_coast_figures(const Json& result, const sim::Recording<double>& recording) {
  Section section{"Coastdowns"};
  if (!result.contains("coastdowns") || result["coastdowns"].empty()) return section;
  section.blocks = {make_coast_chart(list_coasts(result["coastdowns"], recording))};
  return section;
}

Section make_run_figures(const Json& result) {
  Section section{"Figures"};
  const auto add = [&](const char* key, auto&& make) {
    const auto at = result.find(key);
    if (at != result.end() && at->is_array() && !at->empty()) section.blocks.push_back(make(*at));
  };
  if (result.contains("sections")) section.title = "Section by section";
  const Json sections = result.value("sections", Json::array());
  if (has_numbers(sections, "temperature_start_degC")) add("sections", make_section_temperatures);
  if (result.contains("cycles") && result["cycles"].size() > 1) {
    if (result.contains("rrc_25degC_2m_N_per_kN")) add("cycles", make_cycle_coefficients);
    add("cycles", make_cycle_forces);
  }
  return section;
}

}  // namespace rollrig::report
