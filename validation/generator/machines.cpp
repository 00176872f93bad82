#include "validation/generator/machine.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"

namespace rollrig::generator {
namespace {

constexpr GivenColumn kTime{"time_s", &RunRecord::time_s, "{:.0f}"};
constexpr GivenColumn kSpeed{"speed_km_h", &RunRecord::speed_km_h, "{:.9g}"};
constexpr GivenColumn kLoad{"load_N", &RunRecord::load_N, "{:.10g}"};
constexpr GivenColumn kPull{"longitudinal_force_N", &RunRecord::longitudinal_N, "{:.9g}"};
constexpr GivenColumn kElevation{"elevation_m", &RunRecord::elevation_m, "{:.9g}"};
constexpr GivenColumn kAmbient{"ambient_degC", &RunRecord::ambient_degC, "{:.2f}"};

constexpr Channel kLiner{"liner_temperature_degC", "tire", {0.25, 0.05, 60.0, 0.1, 0.1}};
constexpr Channel kPressure{"cavity_pressure_kPa", "tire", {0.25, 0.10, 120.0, 0.05, 0.1}};

/// What drum and dynamometer have in common.
class Rig : public Machine {
 public:
  bool has_vehicle() const override { return false; }
  bool gives(const Specimen&, Base which) const override { return which <= Base::kC2; }
  std::string write_set_keys(const Specimen&) const override { return "rig = \"rig.toml\"\n"; }
  std::string file_name() const override { return "rig.toml"; }

  /// Standards' correction from the drum on which A holds (2 m) to this one.
  double calc_curvature_factor(const Specimen& specimen) const override {
    const double tire_m = 0.5 * specimen.outer_diameter_m;
    const double here_m = 0.5 * specimen.drum_diameter_m;
    return std::sqrt((here_m + tire_m) / (here_m * (1.0 + tire_m)));
  }

 protected:
  /// Tables up to the environment; `body` is what turns.
  std::string write_rig(const Specimen& specimen, const char* body) const {
    return fmt::format("format = \"rollrig-rig/1\"\nname = \"laboratory\"\nkind = \"{}\"\n\n[{}]\n", name(), body) +
           fmt::format("diameter_m = {:.10g}\ninertia_kg_m2 = {:.10g}\n\n[parasitic]\n", specimen.drum_diameter_m,
                       specimen.drum_inertia_kg_m2) +
           write_identified(specimen, Base::kC0, Base::kC2) +
           fmt::format("\n[environment]\nambient_degC = {:.10g}\n", specimen.ambient_degC);
  }
};

class Drum : public Rig {
 public:
  const char* name() const override { return "drum"; }
  Grounds grounds() const override { return kDrumGround; }
  bool has_knots() const override { return false; }
  const std::vector<GivenColumn>& given_columns() const override {
    static const std::vector<GivenColumn> columns{kTime, kSpeed, kLoad, kAmbient};
    return columns;
  }
  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> channels{
        {"drum_torque_Nm", "torque", {0.45, 0.10, 60.0, 0.25, 0.0}}, kLiner, kPressure};
    return channels;
  }
  std::string write_file(const Specimen& specimen) const override {
    return write_rig(specimen, "drum") + fmt::format("\n[skim]\nload_N = {:.10g}\n", specimen.skim_load_N);
  }
  void draw_own(std::uint64_t, Specimen&) const override {}
  Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) const override {
    return draw_drum_campaign(order, specimen);
  }
  double find_lever(const Specimen& specimen) const override { return 0.5 * specimen.drum_diameter_m; }
  double calc_moving_mass_kg(const Specimen& specimen, double load_N, double target_load_N) const override {
    const double drum_m = 0.5 * specimen.drum_diameter_m;
    const double drum_kg = specimen.drum_inertia_kg_m2 / (drum_m * drum_m);
    if (target_load_N <= 0.0) return drum_kg;  // the wheel is off the drum
    const double wheel_m = 0.5 * specimen.outer_diameter_m - load_N / specimen.vertical_N_per_m;
    return drum_kg + specimen.spin_inertia_kg_m2 / (wheel_m * wheel_m);
  }
};

class Dyno : public Rig {
 public:
  const char* name() const override { return "dyno"; }
  Grounds grounds() const override { return kDynoGround; }
  bool has_knots() const override { return true; }
  const std::vector<GivenColumn>& given_columns() const override {
    static const std::vector<GivenColumn> columns{kTime, kSpeed, kLoad, kPull, kAmbient};
    return columns;
  }
  const std::vector<Channel>& channels() const override {
    // Assumed: a loss is the difference of two torques, so it is noisier than a drum's torque.
    static const std::vector<Channel> channels{
        {"loss_force_N", "torque", {0.6, 0.25, 60.0, 1.0, 0.0}}, kLiner, kPressure};
    return channels;
  }
  std::string write_file(const Specimen& specimen) const override { return write_rig(specimen, "roller"); }
  void draw_own(std::uint64_t seed, Specimen& specimen) const override {
    Draws draws(seed, "specimen/roller");
    specimen.drum_diameter_m = draws.happens(0.7) ? 1.2 : 1.2192;  // 1.2192 m: the 48 inch roller
    specimen.drum_inertia_kg_m2 = round_to(draws.uniform(90.0, 150.0), 3);
  }
  Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) const override {
    return draw_dyno_campaign(order, specimen);
  }
  double find_lever(const Specimen&) const override { return 1.0; }
  double calc_moving_mass_kg(const Specimen&, double, double) const override { return 0.0; }  // the rig compensates it
};

class Road : public Machine {
 public:
  const char* name() const override { return "road"; }
  Grounds grounds() const override { return kRoadGrounds; }
  bool has_vehicle() const override { return true; }
  bool has_knots() const override { return true; }
  const std::vector<GivenColumn>& given_columns() const override {
    static const std::vector<GivenColumn> columns{kTime, kSpeed, kElevation, kAmbient};
    return columns;
  }
  const std::vector<Channel>& channels() const override {
    // Assumed: a force on the road has unevenness, gusts and gear noise in it, less than a trip in traffic has.
    static const std::vector<Channel> channels{{"traction_force_N", "vehicle", {8.0, 40.0, 13.0, 60.0, 0.0}}};
    return channels;
  }
  bool gives(const Specimen& specimen, Base which) const override {
    if (specimen.constant_rrc) return which >= Base::kMass;
    return which <= Base::kF || (which >= Base::kMass && which < Base::kRrc);
  }
  std::string write_set_keys(const Specimen& specimen) const override {
    return fmt::format("kind = \"road\"\nvehicle = \"vehicle.toml\"\nbaseline = \"{}\"\n", name_of_law(specimen));
  }
  std::string file_name() const override { return "vehicle.toml"; }
  std::string write_file(const Specimen& specimen) const override {
    return "format = \"rollrig-vehicle/1\"\nname = \"car\"\n" +
           write_identified(specimen, Base::kMass, Base::kDragArea) +
           fmt::format("tires = {:.0f}\n\n[powertrain]\nregeneration_limit_m_s2 = {:.10g}\n", specimen.tires,
                       specimen.regeneration_m_s2) +
           fmt::format("regeneration_fade_km_h = {:.10g}\n", 3.6 * specimen.regeneration_fade_m_s);
  }
  /// The vehicle's bearings are in what is called its tires' loss.
  void draw_own(std::uint64_t, Specimen& specimen) const override {
    for (const Base none : {Base::kC0, Base::kC1, Base::kC2}) specimen.base[static_cast<std::size_t>(none)].truth = 0.0;
  }
  Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) const override {
    return draw_road_campaign(order, specimen);
  }
  double calc_curvature_factor(const Specimen& specimen) const override {
    return specimen.constant_rrc ? 1.0 : 1.0 / std::sqrt(1.0 + 0.5 * specimen.outer_diameter_m);
  }
  double find_lever(const Specimen&) const override { return 1.0; }
  double calc_moving_mass_kg(const Specimen& specimen, double, double) const override {
    return specimen.truth(Base::kMass) + specimen.truth(Base::kRotatingMass);
  }
};

}  // namespace

const std::vector<const Machine*>& all_machines() {
  static const Drum drum;
  static const Dyno dyno;
  static const Road road;
  static const std::vector<const Machine*> machines{&drum, &dyno, &road};
  return machines;
}

const Machine& find_machine(const std::string& name) {
  std::vector<std::string> known;
  for (const Machine* machine : all_machines()) {
    if (name == machine->name()) return *machine;
    known.emplace_back(machine->name());
  }
  InputProblem problem = unknown_name("kind", name, known);
  problem.key = "--kind";
  throw InputError(problem);
}

std::string list_grounds(Grounds grounds) {
  std::vector<std::string> names;
  if ((grounds & kDrumGround) != 0) names.emplace_back("drum");
  if ((grounds & kDynoGround) != 0) names.emplace_back("dyno");
  if ((grounds & kRoadGround) != 0) names.emplace_back("road (combined)");
  if ((grounds & kConstantGround) != 0) names.emplace_back("road (constant_rrc)");
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace rollrig::generator
