#include <cmath>

#include "tools/drive_tables.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

const std::vector<std::string> kVehicleConditions{"load_N=5400", "pressure_kPa=280"};

Json run(const std::string& scenario, const std::string& tire, const std::vector<std::string>& settings = {},
         const char* fidelity = "quasi_static") {
  return scenarios::run_scenario(make_spec(scenario, tire, settings, {{"fidelity", fidelity}}), {}).result;
}

Rows list_iso() {
  const std::array<double, 3> source{5.93, 5.20, 5.60};
  Rows rows;
  for (std::size_t i = 0; i < kTires.size(); ++i) {
    const Json result = run("iso_28580", kTires[i], {}, "multibody");
    const double rrc = number(result, "rrc_25degC_2m_N_per_kN");
    rows.push_back(fmt::format("| {} | {:.0f} | {:.2f} | {:.3f} | {:+.2f} |", kTires[i], number(result, "load_N"),
                               source[i], rrc, 100.0 * (rrc / source[i] - 1.0)));
  }
  return rows;
}

Rows list_warm_ups() {
  Rows rows;
  for (const std::string& tire : kTires) {
    for (const bool vehicle : {false, true}) {
      const Json r = run("warm_up", tire, vehicle ? kVehicleConditions : std::vector<std::string>{});
      rows.push_back(fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {:.4f} |", tire,
                                 vehicle ? "5400 N, 280 kPa" : "ISO load, 250 kPa",
                                 number(r, "start_rolling_resistance_N"), number(r, "rolling_resistance_N"),
                                 number(r, "start_excess_percent"), number(r, "band_drop_percent"),
                                 number(r, "band_drop_N"), number(r, "band_B_per_degC")));
    }
  }
  return rows;
}

/// Slope of the ISO test's RRc over air temperature, and what remains of the difference after the correction.
Rows list_slopes() {
  Rows rows;
  for (const std::string& tire : kTires) {
    const Json cold = run("iso_28580", tire, {"ambient_degC=20"});
    const Json warm = run("iso_28580", tire, {"ambient_degC=30"});
    const auto ratio = [&](const char* key) { return number(cold, key) / number(warm, key); };
    rows.push_back(fmt::format("| {}, virtual ISO test | {:.2f} | {:+.1f} |", tire,
                               -10.0 * std::log(ratio("rrc_N_per_kN")),
                               100.0 * (ratio("rrc_25degC_2m_N_per_kN") - 1.0)));
  }
  return rows;
}

Rows list_vehicle_loads() {
  Rows rows;
  for (const std::string& tire : kTires) {
    const double iso = number(run("iso_28580", tire), "rrc_N_per_kN");
    const double vehicle = number(run("iso_28580", tire, kVehicleConditions), "rrc_N_per_kN");
    rows.push_back(fmt::format("| {} | {:.3f} | {:.3f} | {:+.3f} |", tire, iso, vehicle, vehicle - iso));
  }
  return rows;
}

double pressure_ratio(const std::string& tire, double exponent) {
  return number(
      run("pressure_sweep", tire,
          {"pressures_kPa=[250, 280]", fmt::format("tire.rolling_resistance.pressure_exponent={}", exponent)}),
      "first_to_second_ratio");
}

Rows list_pressure_ratios() {
  Rows rows;
  for (const std::string& tire : kTires) {
    const double exponent = find_root([&](double a) { return pressure_ratio(tire, a) - 1.0453; }, 0.3, 1.0);
    rows.push_back(fmt::format("| {} | {:.4f} | {:.3f} |", tire, pressure_ratio(tire, 0.4), exponent));
  }
  return rows;
}

std::string load_row(const std::string& tire, const std::string& law, const Json& result) {
  Rows cycles;
  for (const Json& cycle : result["cycles"]) {
    cycles.push_back(fmt::format("{:.0f} N: {:.3f}", number(cycle, "load_N"), number(cycle, "rrc_N_per_kN")));
  }
  return fmt::format("| {} | {} | {} | {:.3f} |", tire, law, fmt::join(cycles, ", "),
                     number(result, "rrc_span_N_per_kN"));
}

Rows list_loads() {
  Rows rows;
  for (const std::string& tire : kTires) {
    const auto with_exponent = [&](double b) {
      return run("load_sweep", tire, {fmt::format("tire.bounded.load_exponent={}", b)});
    };
    const models::TireParameters<double> p = make_source_drive(tire).tire.values;
    const double own = *joint::find_number(p, "load_exponent");
    const double constant =
        find_root([&](double b) { return number(with_exponent(b), "steady_state_load_exponent") - 1.0; }, 0.9, 1.8);
    rows.push_back(load_row(tire, fmt::format("{:.3f}, of the tire", own), with_exponent(own)));
    rows.push_back(load_row(tire, fmt::format("{:.3f}, which makes RRc constant", constant), with_exponent(constant)));
  }
  return rows;
}

Rows list_speeds() {
  Rows rows;
  for (const std::string& tire : kTires) {
    const Json result = run("speed_sweep", tire);
    rows.push_back("| " + tire + " |");
    for (const Json& cycle : result["cycles"]) rows.back() += fmt::format(" {:.3f} |", number(cycle, "rrc_N_per_kN"));
  }
  return rows;
}

/// Rise of the liner in steady state for 10 degC more of air, and of surface.
std::pair<double, double> find_sensitivities(std::vector<std::string> settings) {
  settings.push_back("warm_up_min=120");
  const auto liner = [&settings](const char* air, const char* surface) {
    std::vector<std::string> all = settings;
    all.push_back(std::string("ambient_degC=") + air);
    all.push_back(std::string("surface_temperature_degC=") + surface);
    all.push_back("initial_tire_temperature_degC=20");
    return number(run("warm_up", "a50", all), "liner_temperature_degC");
  };
  const double base = liner("20", "20");
  return {liner("30", "20") - base, liner("20", "30") - base};
}

Rows list_temperatures() {
  Rows rows;
  const auto add = [&rows](const std::string& label, const std::vector<std::string>& settings) {
    const auto [air_dK, road_dK] = find_sensitivities(settings);
    rows.push_back(fmt::format("| {} | {:+.1f} | {:+.1f} |", label, air_dK, road_dK));
  };
  add("a50 of the assets: 0.8 of both conductances to the road", {});
  add("half of that at rest to the road, that per speed to the air (files without shares)",
      {"tire.thermal.road_share_of_conductance_at_rest=0.5", "tire.thermal.road_share_of_conductance_per_speed=0"});
  return rows;
}

}  // namespace

std::string make_published_page() {
  using fmt::literals::operator""_a;
  Drives drives;
  for (const std::string& tire : kTires) drives[tire] = drive_source_test(tire);
  const joint::JointCalibration calibration(joint::read_files(), kPublishedFolder);
  const Observations all = calibration.observe(calibration.read_unknowns());
  const auto [figure_3_13, fits] = list_figure_3_13();
  return fill_page("published", "sections"_a = join(list_sections(all)), "figure_3_13"_a = join(figure_3_13),
                   "figure_3_13_fits"_a = fmt::join(fits, "; "), "table_5_1"_a = join(list_table_5_1(all)),
                   "table_4_2"_a = join(list_table_4_2(all)), "statements"_a = join(list_statements(drives)),
                   "iso"_a = join(list_iso()), "slopes"_a = join(list_slopes()), "warm_up"_a = join(list_warm_ups()),
                   "vehicle_load"_a = join(list_vehicle_loads()), "pressure"_a = join(list_pressure_ratios()),
                   "load"_a = join(list_loads()), "speed"_a = join(list_speeds()),
                   "temperature"_a = join(list_temperatures()));
}

}  // namespace rollrig::tools
