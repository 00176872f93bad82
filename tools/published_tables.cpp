#include "tools/published_tables.h"

#include <fmt/format.h>

#include <boost/math/tools/roots.hpp>
#include <functional>
#include <vector>

#include "scenarios/run/run_spec.h"
#include "tools/drive_tables.h"

namespace rollrig::tools {
namespace {

const std::vector<std::string> kTires{"a40", "a50", "a60"};
const std::vector<std::string> kVehicleConditions{"load_N=5400", "pressure_kPa=280"};

Json run(const std::string& scenario, const std::string& tire, const std::vector<std::string>& settings = {},
         const char* fidelity = "quasi_static") {
  ConfigTable document = scenarios::make_run_document(scenario);
  set_config_value(document, "tire", tire, "tools/published_tables");
  set_config_value(document, "fidelity", fidelity, "tools/published_tables");
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  const scenarios::RunSpec spec = scenarios::read_run_spec(document, "");
  return scenarios::run_scenario(spec, {}).result;
}

double number(const Json& result, const char* key) { return result[key].get<double>(); }

double find_root(const std::function<double(double)>& f, double low, double high) {
  std::uintmax_t iterations = 60;
  const auto bracket =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(30), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

std::string page_head() {
  return "# Virtual tests beside the source's published numbers\n\n"
         "Written by `cmake --build build/release --target docs_pages`; a test holds it to what the\n"
         "program gives now. What was fitted: for each tire nine parameters (A0, A1, B0, B1; z and f on the\n"
         "dynamometer; z and f on the drum; heat capacity) to 8 + 1 numbers of the drive cycle and 3 to 5 of the "
         "drum,\n"
         "with weak priors (`cmake --build build/release --target calibrated_tires`; weights and priors:\n"
         "`tools/virtual_tests.cpp`, numbers: `tests/published`). Those tables say \"fitted\".\n";
}

std::string iso_table() {
  std::string text =
      "\n## RRc of the ISO test (fitted)\n\n| tire | load N | source N/kN | virtual, multibody | difference % "
      "|\n|---|---|---|---|---|\n";
  const std::vector<double> source{5.93, 5.20, 5.60};
  for (std::size_t i = 0; i < kTires.size(); ++i) {
    const Json result = run("iso_28580", kTires[i], {}, "multibody");
    const double rrc = number(result, "rrc_25degC_2m_N_per_kN");
    text += fmt::format("| {} | {:.0f} | {:.2f} | {:.3f} | {:+.2f} |\n", kTires[i], number(result, "load_N"), source[i],
                        rrc, 100.0 * (rrc / source[i] - 1.0));
  }
  return text + "\nSource: Table 5.1, order a50 < a60 < a40 as in Figure 4.1. Each at its own ISO load and 250 kPa.\n";
}

std::string warm_up_table() {
  std::string text =
      "\n## Warm-up\n\n| tire | conditions | start N | end N | start above end % | fall 30 to 35 degC % | fall N | B "
      "1/degC |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const std::string& tire : kTires) {
    for (const bool vehicle : {false, true}) {
      const Json r = run("warm_up", tire, vehicle ? kVehicleConditions : std::vector<std::string>{});
      text += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {:.4f} |\n", tire,
                          vehicle ? "5400 N, 280 kPa" : "ISO load, 250 kPa", number(r, "start_rolling_resistance_N"),
                          number(r, "rolling_resistance_N"), number(r, "start_excess_percent"),
                          number(r, "band_drop_percent"), number(r, "band_drop_N"), number(r, "band_B_per_degC"));
    }
  }
  return text +
         "\nSource: §6 and abstract, start 25 to 40 % above steady state by tire, load not said: held at ISO load, "
         "where\n"
         "a40 is at the upper end. §4.1.6 (fitted): a50 -7.82 %, -2.50 N, B 0.0163; a60 -7.12 %, B 0.0148. Not met: "
         "a60's\n"
         "-2.37 N, that is 33.3 N at 30 degC. With B 0.0148 that is 37.0 N at 23 degC and 80 km/h; Table 4.4's City 1 "
         "asks\n"
         "for 37.8 N (36.1 % above 5.60 N/kN, over (3.1)'s 1.088), in the mean of a section that is warmer and slower. "
         "No\n"
         "heat transfer makes up for it while the loss rises with speed (§4.1.5). Of a40 the published pair "
         "contradicts\n"
         "itself; its B is at the lower end of 0.020 to 0.026 (§4.4.3).\n";
}

std::string vehicle_load_table() {
  std::string text =
      "\n## ISO load against vehicle load (predicted)\n\n| tire | RRc ISO N/kN | RRc at 5400 N, 280 kPa | difference "
      "|\n|---|---|---|---|\n";
  for (const std::string& tire : kTires) {
    const double iso = number(run("iso_28580", tire), "rrc_N_per_kN");
    const double vehicle = number(run("iso_28580", tire, kVehicleConditions), "rrc_N_per_kN");
    text += fmt::format("| {} | {:.3f} | {:.3f} | {:+.3f} |\n", tire, iso, vehicle, vehicle - iso);
  }
  return text + "\nSource: §4.1.2, the difference is within the sensor's uncertainty (0.17 N/kN at 5400 N).\n";
}

double pressure_ratio(const std::string& tire, double exponent) {
  return number(
      run("pressure_sweep", tire,
          {"pressures_kPa=[250, 280]", fmt::format("tire.rolling_resistance.pressure_exponent={}", exponent)}),
      "first_to_second_ratio");
}

std::string pressure_table() {
  std::string text =
      "\n## Pressure ratio of (4.1): F_r at 250 kPa over 280 kPa, steady state\n\n"
      "| tire | exponent 0.4 | exponent that gives 1.0453 |\n|---|---|---|\n";
  for (const std::string& tire : kTires) {
    const double exponent = find_root([&](double a) { return pressure_ratio(tire, a) - 1.0453; }, 0.3, 1.0);
    text += fmt::format("| {} | {:.4f} | {:.3f} |\n", tire, pressure_ratio(tire, 0.4), exponent);
  }
  return text +
         "\nSource: (4.1), measured on a40: 1.0453, which the source reads as the exponent 0.4 (1.0463). That holds "
         "at\n"
         "equal temperature; in steady state the softer tire runs warmer, and part of the rise is lost. Each at ISO "
         "load.\n";
}

std::string join_rrc(const Json& result) {
  std::string text;
  for (const Json& cycle : result["cycles"]) {
    text += fmt::format("{}{:.0f} N: {:.3f}", text.empty() ? "" : ", ", number(cycle, "load_N"),
                        number(cycle, "rrc_N_per_kN"));
  }
  return text;
}

std::string load_table() {
  std::string text = "\n## RRc over the load sweep, 280 kPa\n\n| tire | law | RRc N/kN | span |\n|---|---|---|---|\n";
  for (const std::string& tire : kTires) {
    const auto with_exponent = [&](double b) {
      return run("load_sweep", tire, {fmt::format("effects.load_exponent.exponent={}", b)});
    };
    const double b =
        find_root([&](double x) { return number(with_exponent(x), "steady_state_load_exponent") - 1.0; }, 0.9, 1.5);
    const Json plain = run("load_sweep", tire);
    const Json constant = with_exponent(b);
    text += fmt::format("| {} | (3.5) | {} | {:.3f} |\n", tire, join_rrc(plain), number(plain, "rrc_span_N_per_kN"));
    text += fmt::format("| {} | load exponent {:.3f} | {} | {:.3f} |\n", tire, b, join_rrc(constant),
                        number(constant, "rrc_span_N_per_kN"));
  }
  return text +
         "\nSource: §4.1.3, RRc constant over load within the uncertainty (0.17 N/kN) with a warmer tire at higher "
         "load.\n"
         "(3.5) is proportional to load at equal temperature, so it lets RRc fall; a load exponent above 1 makes it\n"
         "constant.\n";
}

std::string speed_table() {
  std::string text =
      "\n## RRc over speed, 5400 N, 280 kPa (a60's rise fitted to be positive, the rest predicted)\n\n"
      "| tire | 40 km/h | 80 km/h | 120 km/h |\n|---|---|---|---|\n";
  for (const std::string& tire : kTires) {
    const Json result = run("speed_sweep", tire);
    text += "| " + tire + " |";
    for (const Json& cycle : result["cycles"]) text += fmt::format(" {:.3f} |", number(cycle, "rrc_N_per_kN"));
    text += "\n";
  }
  return text + "\nSource: §4.1.5, RRc rises with speed; no numbers are given.\n";
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

std::string yokota_table() {
  std::string text =
      "\n## Tire temperature against air and road (trend check, a50, 80 km/h, ISO load)\n\n"
      "| cooling on the drum | air +10 degC | road +10 degC |\n|---|---|---|\n"
      "| Yokota et al., §2.2.2.4 | +1 to +2 | +6 to +7 |\n";
  const auto add = [&text](const std::string& label, const std::vector<std::string>& settings) {
    const auto [air_dK, road_dK] = find_sensitivities(settings);
    text += fmt::format("| {} | {:+.1f} | {:+.1f} |\n", label, air_dK, road_dK);
  };
  add("a50 of the assets: z 17.2 W/K (half to the road), f 1.44 W s/(m K)", {});
  add("as much in all, most of it to the road: z 44.8 W/K (0.90), f 0.2",
      {"tire.thermal.rig.drum_2m.conductance_at_rest_W_per_K=44.8",
       "tire.thermal.rig.drum_2m.conductance_per_speed_W_s_per_m_K=0.2",
       "tire.thermal.road_share_of_conductance_at_rest=0.90"});
  return text +
         "\nBoth rise, as they must, and their sum (8 of 10 degC) agrees with Yokota's: the rest is the loss's own "
         "fall\n"
         "with temperature. The split does not: the assets' road share is assumed (one half of z), and Yokota's "
         "numbers\n"
         "ask for most of the cooling through the contact. RRc_ISO cannot tell, since it fixes the sum at 80 km/h "
         "only.\n";
}

}  // namespace

std::string make_published_page() {
  const std::string folder = ROLLRIG_SOURCE_DIR "/tests/published";
  return page_head() + make_energy_tables(folder) + make_statement_table() + iso_table() + warm_up_table() +
         vehicle_load_table() + pressure_table() + load_table() + speed_table() + yokota_table();
}

}  // namespace rollrig::tools
