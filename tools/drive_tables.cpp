#include "tools/drive_tables.h"

#include <algorithm>
#include <cmath>

#include "tools/figure_3_13.h"

namespace rollrig::tools {
namespace {

std::string section_row(const std::string& label, const std::vector<double>& fractions) {
  std::string text = "| " + label + " |";
  for (const double fraction : fractions) text += fmt::format(" {:+.1f} |", 100.0 * fraction);
  return text;
}

double find_rms(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]) / static_cast<double>(a.size());
  return std::sqrt(squares);
}

/// Energy over a distance of a coefficient at the load of §3.4.1.
double calc_Wh_per_km(double rrc_N_per_kN) {
  constexpr double kLoad_kN = 5.4;
  return rrc_N_per_kN * kLoad_kN * 1e3 / 3600.0;
}

std::string expected_file(const char* table) { return fmt::format("{}/{}/expected.toml", kPublishedFolder, table); }

}  // namespace

const joint::Observation& find_observation(const Observations& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&name](const auto& one) { return one.name == name; });
  if (found == all.end()) throw RunFailure("no observation '" + name + "'");
  return *found;
}

Rows list_sections(const Observations& all) {
  Rows rows;
  for (const std::string& tire : kTires) {
    std::vector<double> published, found;
    for (int i = 0; i < 8; ++i) {
      const joint::Observation& section = find_observation(all, fmt::format("{} section {}", tire, i));
      published.push_back(section.published / 100.0);
      found.push_back(section.fitted / 100.0);
    }
    rows.push_back(section_row(tire + ", published", published) + " |");
    rows.push_back(section_row(tire + ", virtual", found) +
                   fmt::format(" {:.2f} |", 100.0 * find_rms(found, published)));
  }
  return rows;
}

std::pair<Rows, Rows> list_figure_3_13() {
  const std::vector<double> published = read_published_tire(kPublishedFolder, "a50").sections();
  Rows rows{section_row("published", published) + " |"};
  Rows fits;
  for (const double C_J_per_K : {18040.0, 25300.0}) {
    const CoolingFit fit = fit_cooling_to_figure_3_13(published, C_J_per_K);
    rows.push_back(section_row(fmt::format("C {:.0f} J/K", C_J_per_K), fit.differences) +
                   fmt::format(" {:.2f} |", 100.0 * fit.rms));
    fits.push_back(fmt::format("at {:.0f} J/K z {:.1f} W/K and f {:.2f} W s/(m K)", C_J_per_K,
                               fit.rest_conductance_W_per_K, fit.speed_conductance_W_s_per_m_K));
  }
  return {rows, fits};
}

Rows list_table_5_1(const Observations& all) {
  Rows rows;
  for (const std::string& tire : kTires) {
    read_published_table(expected_file("table_5_1"), tire, [&](TableReader& reader) {
      const auto published = [&reader](const char* key) { return reader.number({key, any_number(), ""}); };
      rows.push_back(fmt::format("| {}, published | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |", tire,
                                 published("city"), published("highway"), published("overall"), published("iso"),
                                 100.0 * published("difference_percent")));
    });
    const double city = find_observation(all, tire + " city").fitted;
    const double highway = find_observation(all, tire + " highway").fitted;
    const double overall = 0.5 * (city + highway);
    const double iso = calc_Wh_per_km(find_observation(all, tire + " RRc").fitted);
    rows.push_back(fmt::format("| {}, virtual | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |", tire, city, highway,
                               overall, iso, 100.0 * (overall - iso) / overall));
  }
  return rows;
}

Rows list_table_4_2(const Observations& all) {
  const auto find_reported = [](const std::string& tire) {
    const HighwayEnergy energy = find_highway_energy(drive_dyno_setting(tire));
    const double share = joint::run_iso_test(make_spec("iso_28580", tire)).reported_share;
    return HighwayEnergy{share * energy.model_Wh, energy.iso_Wh};
  };
  const HighwayEnergy a50 = find_reported("a50");
  Rows rows;
  for (const std::string tire : {"a40", "a60"}) {
    const HighwayEnergy energy = find_reported(tire);
    read_published_table(expected_file("table_4_2"), tire + "_less_a50", [&](TableReader& reader) {
      const auto published = [&reader](const char* key) { return reader.number({key, any_number(), ""}); };
      rows.push_back(fmt::format("| {} - a50 | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |", tire,
                                 published("measured"), published("model"),
                                 find_observation(all, tire + " - a50").fitted, energy.model_Wh - a50.model_Wh,
                                 published("iso"), energy.iso_Wh - a50.iso_Wh));
    });
  }
  return rows;
}

}  // namespace rollrig::tools
