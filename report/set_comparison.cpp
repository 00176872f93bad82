#include "report/set_comparison.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/comparison/report_unit.h"
#include "report/blocks.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using diagnosis::PreparedRun;
using diagnosis::PreparedSet;
using diagnosis::Series;

void simulate_run(const PreparedSet& set, std::size_t run, models::Corner<double>& corner,
                  std::vector<double>& values) {
  const PreparedRun& prepared = set.runs()[run];
  const sim::Recording<double> recording =
      prepared.resimulation.simulate(set.source(), prepared.simulated.run, corner, rigs::Detail::kMeasured);
  for (const Series& series : set.series()) {
    if (series.run != run) continue;
    const std::vector<double>& rows = recording.channel(set.channels()[series.channel]);
    for (std::size_t k = 0; k < series.size(); ++k) {
      values[series.first_residual + k] = series.mean_of_simulated(k, rows);
    }
  }
}

Json make_run_phases(const PreparedRun& run) {
  Json phases = Json::array();
  const std::vector<double>& time_s = run.measured.time_s;
  for (const diagnosis::RunPhase& phase : run.phases) {
    const std::size_t last = std::min(phase.last, time_s.size() - 1);
    phases.push_back({{"name", phase.name}, {"start_s", time_s[phase.first]}, {"end_s", time_s[last]}});
  }
  return phases;
}

Json make_measured(const PreparedSet& set, const Series& series) {
  const std::string channel = set.channels()[series.channel].header();
  Json measured = make_series("measured", series.time_s, in_unit_of(channel, series.measured));
  measured["points"] = true;
  return measured;
}

std::vector<double> subtract(const std::string& channel, const Series& series, const SimulatedSet& simulated) {
  const double factor = unit_of_key(channel).factor;
  std::vector<double> left;
  for (std::size_t k = 0; k < series.size(); ++k) {
    left.push_back((series.measured[k] - simulated.values[series.first_residual + k]) / factor);
  }
  return left;
}

/// The channel with what is measured and simulated, and below it what is left.
void add_panels(const PreparedSet& set, const Series& series, const std::vector<SimulatedSet>& all, Json& panels) {
  const std::string channel = set.channels()[series.channel].header();
  const std::string label = capitalized(plain_name(channel));
  Json values = Json::array({make_measured(set, series)});
  Json left = Json::array();
  for (const SimulatedSet& simulated : all) {
    if (simulated.values.empty()) continue;
    const double* first = simulated.values.data() + series.first_residual;
    values.push_back(make_series(simulated.name, series.time_s, in_unit_of(channel, {first, first + series.size()})));
    left.push_back(make_series(simulated.name, series.time_s, subtract(channel, series, simulated)));
  }
  panels.push_back({{"label", label}, {"unit", shown_unit(channel)}, {"series", values}});
  if (left.empty()) return;
  left.front()["zero"] = true;
  panels.push_back(
      {{"label", label + ", measured − simulated"}, {"unit", shown_unit(channel)}, {"series", left}, {"low", true}});
}

/// Mean of measured minus simulated over a phase; not a number where the series has no block in it.
double calc_mean_over(std::size_t phase, const Series& series, const SimulatedSet& simulated) {
  double sum = 0.0;
  double blocks = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (series.phase[k] != phase) continue;
    sum += series.measured[k] - simulated.values[series.first_residual + k];
    blocks += 1.0;
  }
  return sum / blocks;
}

/// The clearest stretch within a phase that the diagnosis lists.
const Location* find_listed(const std::vector<Location>& where, const std::string& channel, const std::string& run,
                            const std::string& phase) {
  const Location* found = nullptr;
  for (const Location& at : where) {
    const bool is_here = at.channel == channel && at.run == run && at.phase.rfind(phase, 0) == 0 &&
                         (at.phase.size() == phase.size() || at.phase[phase.size()] == ',');
    if (is_here && (found == nullptr || std::abs(at.z) > std::abs(found->z))) found = &at;
  }
  return found;
}

/// From 1 to 4 by how clear it is, below 0 where the measurement lies below.
int find_shade(double z) {
  const double size = std::abs(z);
  const int shade = size < 6.0 ? 1 : size < 12.0 ? 2 : size < 30.0 ? 3 : 4;
  return z < 0.0 ? -shade : shade;
}

Json make_cell(const PreparedSet& set, const Series& series, std::size_t phase, const SimulatedSet& simulated,
               const std::vector<Location>& where) {
  const PreparedRun& run = set.runs()[series.run];
  const Quantity& channel = set.channels()[series.channel];
  const double mean = calc_mean_over(phase, series, simulated);
  if (std::isnan(mean)) return nullptr;
  const diagnosis::ReportUnit unit = diagnosis::find_report_unit(set, channel);
  Json json = {{"text", fmt::format("{:+.2f}", unit.per_SI * mean)}, {"shade", 0}};
  const Location* listed = find_listed(where, channel.header(), run.measured.id, run.phases[phase].name);
  if (listed == nullptr) return json;
  json["text"] = fmt::format("{:+.2f}", listed->size);
  json["shade"] = find_shade(listed->z);
  json["marked"] = fmt::format("z {:.1f}", listed->z);
  json["note"] = fmt::format("{}: {:+.3g} {} beyond what recalibration takes, {:.0f} % of the gap", listed->phase,
                             listed->size, pretty_unit(listed->unit), listed->share_percent);
  return json;
}

}  // namespace

SimulatedSet simulate_set(const PreparedSet& set, const std::string& name, const models::Context<double>& context,
                          const std::vector<models::ActiveEffect>& effects) {
  SimulatedSet simulated{name, std::vector<double>(set.residual_count(), 0.0)};
  try {
    for (std::size_t run = 0; run < set.runs().size(); ++run) {
      models::Corner<double> corner(context, effects);
      simulate_run(set, run, corner, simulated.values);
    }
  } catch (const RunFailure&) {
    simulated.values.clear();  // the page then shows the measurement without it
  }
  return simulated;
}

Block make_comparison(const PreparedSet& set, std::size_t run, const std::vector<SimulatedSet>& simulated) {
  Json panels = Json::array();
  for (const Series& series : set.series()) {
    if (series.run == run) add_panels(set, series, simulated, panels);
  }
  return {{"type", "times"},
          {"unlinked", true},
          {"phases", make_run_phases(set.runs()[run])},
          {"panels", panels},
          {"title", set.runs()[run].measured.id},
          {"caption", "Means over blocks of ten seconds."}};
}

Json list_phase_means(const PreparedSet& set, const SimulatedSet& simulated) {
  Json means = Json::array();
  if (simulated.values.empty()) return means;
  for (const Series& series : set.series()) {
    const PreparedRun& run = set.runs()[series.run];
    const Quantity& channel = set.channels()[series.channel];
    const diagnosis::ReportUnit unit = diagnosis::find_report_unit(set, channel);
    for (std::size_t phase = 0; phase < run.phases.size(); ++phase) {
      const double mean = calc_mean_over(phase, series, simulated);
      if (std::isnan(mean)) continue;
      means.push_back({{"run", run.measured.id},
                       {"phase", run.phases[phase].name},
                       {"channel", channel.header()},
                       {"mean", unit.per_SI * mean},
                       {"unit", unit.symbol}});
    }
  }
  return means;
}

Json list_phase_means(const measurements::MeasurementSet& set) {
  const PreparedSet prepared(set);
  return list_phase_means(prepared, simulate_set(prepared, "", measurements::make_context(prepared.source()), {}));
}

Block make_gap_map(const PreparedSet& set, const SimulatedSet& simulated, const std::vector<Location>& where) {
  Block block = {
      {"type", "map"},
      {"caption", "Measured minus simulated, by run, phase and channel"},
      {"columns", Json::array()},
      {"rows", Json::array()},
      {"legend",
       "Outlined: what stays beyond noise and beyond what a recalibration within the files' uncertainties takes, "
       "with its z; warm above, cool below, deeper the clearer; it exceeds what the recalibrated curve of the charts "
       "leaves where that has bent towards the gap. All other numbers: mean over the phase with the files' own "
       "numbers, sensor offsets included."}};
  for (const Quantity& channel : set.channels()) {
    const std::string unit = pretty_unit(diagnosis::find_report_unit(set, channel).symbol);
    block["columns"].push_back(plain_name(channel.header()) + ", " + unit);
  }
  for (std::size_t run = 0; run < set.runs().size(); ++run) {
    const PreparedRun& prepared = set.runs()[run];
    for (std::size_t phase = 0; phase < prepared.phases.size(); ++phase) {
      Json cells(set.channels().size(), nullptr);
      bool is_empty = true;
      for (const Series& series : set.series()) {
        if (series.run != run) continue;
        cells[series.channel] = make_cell(set, series, phase, simulated, where);
        is_empty = is_empty && cells[series.channel].is_null();
      }
      if (is_empty) continue;
      block["rows"].push_back(
          {{"group", prepared.measured.id}, {"label", prepared.phases[phase].name}, {"cells", cells}});
    }
  }
  return block;
}

}  // namespace rollrig::report
