#include "tools/multi_cycle.h"

#include <fmt/format.h>

#include <boost/math/tools/minima.hpp>

#include "rigs/vehicle_file.h"
#include "sim/core/assets.h"
#include "sim/core/csv.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

constexpr double kMile_m = 1609.344;
constexpr double kConstantSpeed_m_s = 65.0 * kMile_m / 3600.0;  // 40 CFR 600.116-12(a)(5)
constexpr double kRamp_s = 30.0;
constexpr std::size_t kMid = 3;  // constant-speed sections, in the order of the test
constexpr std::size_t kEnd = 7;

/// Minutes of a constant-speed section over a distance, ramps included.
double find_minutes(double distance_m) { return (distance_m / kConstantSpeed_m_s + kRamp_s) / 60.0; }

std::vector<std::string> make_settings(const std::vector<CertificateSection>& certificate) {
  return {fmt::format("mid_speed_km_h={}", 3.6 * kConstantSpeed_m_s),
          fmt::format("mid_min={}", find_minutes(certificate[kMid].distance_m)),
          fmt::format("end_min={}", find_minutes(certificate[kEnd].distance_m)), fmt::format("ramp_s={}", kRamp_s)};
}

/// Settings of the rollers, with the tires, with which the vehicle coasts down by its road load.
std::vector<std::string> find_roller_settings(const MultiCycleTest& test, const rigs::VehicleFile& vehicle,
                                              const std::vector<std::string>& tires, double loss_factor) {
  scenarios::RunSpec setting = make_spec("dyno_setting", "a50", tires, {{"rig", "dyno_48in"}});
  scale_loss(setting.tire, loss_factor);
  setting.vehicle = vehicle;
  const Json result = scenarios::run_scenario(setting, {}).result;
  if (!result["within_criterion"].get<bool>()) throw RunFailure("rollers not set for " + test.vehicle);
  std::vector<std::string> settings;
  for (const char* key : {"set_A_N", "set_B_N_per_km_h", "set_C_N_per_km_h2"}) {
    settings.push_back(fmt::format("{}={}", key, result[key].get<double>()));
  }
  return settings;
}

}  // namespace

std::vector<CertificateSection> read_certificate(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  const std::vector<std::string> kind = table.text("kind");
  const std::vector<double> phase = table.numbers({"phase", positive(), ""});
  const std::vector<double> miles = table.numbers({"miles", positive(), ""});
  const std::vector<double> battery_J = table.numbers({"dc_kwh", positive(), ""});  // no unit that keys know
  const std::vector<std::string> order{"udds", "hwfet", "udds", "css65", "udds", "hwfet", "udds", "css65"};
  if (kind != order) {
    throw InputError(
        {"not a multi-cycle test of the standard order", path, 0, "kind", "", "udds, hwfet, udds, css65, twice", ""});
  }
  std::vector<CertificateSection> sections;
  for (std::size_t i = 0; i < kind.size(); ++i) {
    sections.push_back({static_cast<int>(phase[i]), kind[i], kMile_m * miles[i], 3.6e6 * battery_J[i]});
  }
  return sections;
}

std::vector<SimulatedSection> simulate_multi_cycle(const MultiCycleTest& test,
                                                   const std::vector<CertificateSection>& certificate) {
  const rigs::VehicleFile vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", test.vehicle)));
  const bool tires_act = test.rrc_N_per_kN > 0.0;
  const double loss_factor = tires_act ? find_loss_factor(test.rrc_N_per_kN) : 1.0;
  std::vector<std::string> settings = make_settings(certificate);
  if (tires_act) {
    std::vector<std::string> tires{"pressure_kPa=250"};  // Assumed: as the maker asks for
    if (test.driveline_cold_N > 0.0) {
      tires.push_back(fmt::format("effects.driveline_warming.force_N={}", test.driveline_cold_N));
    }
    settings.insert(settings.end(), tires.begin(), tires.end());
    const std::vector<std::string> rollers = find_roller_settings(test, vehicle, tires, loss_factor);
    settings.insert(settings.end(), rollers.begin(), rollers.end());
  }
  scenarios::RunSpec spec = make_spec("sae_j1634", "a50", settings, {{"rig", tires_act ? "dyno_48in" : "road"}});
  scale_loss(spec.tire, loss_factor);
  spec.vehicle = vehicle;
  std::vector<SimulatedSection> sections;
  const Json result = scenarios::run_scenario(spec, {}).result;
  for (const Json& section : result["sections"]) {
    sections.push_back({1e3 * section["distance_km"].get<double>(), 3600.0 * section["wheel_energy_Wh"].get<double>(),
                        3600.0 * section["recuperated_Wh"].get<double>()});
  }
  return sections;
}

double fit_efficiency(const std::vector<SimulatedSection>& simulated,
                      const std::vector<CertificateSection>& certificate, const std::vector<std::size_t>& fitted) {
  const auto sum_squares = [&](double efficiency) {
    double sum = 0.0;
    for (const std::size_t i : fitted) {
      const double deviation = simulated[i].per_m(efficiency) / certificate[i].per_m() - 1.0;
      sum += deviation * deviation;
    }
    return sum;
  };
  return boost::math::tools::brent_find_minima(sum_squares, 0.3, 1.2, 40).first;
}

}  // namespace rollrig::tools
