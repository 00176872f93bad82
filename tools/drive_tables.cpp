#include "tools/drive_tables.h"

#include <cmath>

#include "tools/virtual_tests.h"

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

std::string expected_file(const char* table) { return fmt::format("{}/{}/expected.toml", kPublishedFolder, table); }

}  // namespace

Rows list_sections(const Drives& drives) {
  Rows rows;
  for (const std::string& tire : kTires) {
    const std::vector<double> published = read_published_tire(kPublishedFolder, tire).sections();
    std::vector<double> found;
    for (const DriveSection& section : drives.at(tire)) found.push_back(section.difference());
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

Rows list_table_5_1(const Drives& drives) {
  Rows rows;
  for (const std::string& tire : kTires) {
    read_published_table(expected_file("table_5_1"), tire, [&](TableReader& reader) {
      const auto published = [&reader](const char* key) { return reader.number({key, any_number(), ""}); };
      rows.push_back(fmt::format("| {}, published | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |", tire,
                                 published("city"), published("highway"), published("overall"), published("iso"),
                                 100.0 * published("difference_percent")));
    });
    const EnergyRow row = make_energy_row(drives.at(tire));
    rows.push_back(fmt::format("| {}, virtual | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |", tire, row.city,
                               row.highway, row.overall, row.iso, 100.0 * row.difference));
  }
  return rows;
}

Rows list_table_4_2() {
  std::map<std::string, HighwayEnergy> energy;
  for (const std::string& tire : kTires) energy[tire] = find_highway_energy(drive_dyno_setting(tire));
  Rows rows;
  for (const std::string tire : {"a40", "a60"}) {
    read_published_table(expected_file("table_4_2"), tire + "_less_a50", [&](TableReader& reader) {
      const auto published = [&reader](const char* key) { return reader.number({key, any_number(), ""}); };
      rows.push_back(fmt::format("| {} - a50 | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |", tire,
                                 published("measured"), published("model"),
                                 energy[tire].model_Wh - energy["a50"].model_Wh, published("iso"),
                                 energy[tire].iso_Wh - energy["a50"].iso_Wh));
    });
  }
  return rows;
}

}  // namespace rollrig::tools
