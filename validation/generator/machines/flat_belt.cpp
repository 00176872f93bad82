/// One tire that a carriage presses on a flat belt over two drums. The force that drives the belt is measured.
#include <fmt/format.h>

#include "validation/generator/machine.h"

namespace rollrig::generator::flat_belt {

/// As on a drum: warm-ups, fast running, a load sweep, skims within a run, and a run at another pressure.
const std::vector<CampaignKind> kCampaigns{{"belt of a tire maker",
                                            {{"warm-up 80", "day-1"},
                                             {"load sweep", "day-1"},
                                             {"speed steps", "day-1", 0, 150},
                                             {"transient skim", "day-2"},
                                             {"warm-up 130", "day-2"},
                                             {"load sweep", "day-2", 230}}},
                                           {"belt of a test house",
                                            {{"speed steps", "day-1"},
                                             {"warm-up 80", "day-1", 240},
                                             {"load sweep", "day-2"},
                                             {"up and down", "day-2", 0, 180},
                                             {"transient skim", "day-3"},
                                             {"warm-up 120", "day-3", 310}}}};

/// Assumed: after machines with a steel belt over two drums on a plane bearing, which takes as much as the drums' own.
void draw_own(std::uint64_t seed, Specimen& specimen) {
  Draws draws(seed, "specimen/belt");
  specimen.drum_diameter_m = round_to(draws.uniform(0.6, 0.8), 3);
  const double radius_m = 0.5 * specimen.drum_diameter_m;
  specimen.drum_inertia_kg_m2 = round_to(draws.uniform(350.0, 450.0), 3) * radius_m * radius_m;
  for (const Base bearings : {Base::kC0, Base::kC1}) {
    Identified& number = specimen.base[static_cast<std::size_t>(bearings)];
    for (double* value : {&number.nominal, &number.sd, &number.truth}) *value *= 2.0;
  }
}

Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) {
  return carriage::draw_campaign(order, specimen, kCampaigns);
}

std::string write_file(const Specimen& specimen) {
  const double mass_kg = carriage::calc_moving_mass_kg(specimen, 0.0, 0.0);
  return rig::write_file(specimen, 2, fmt::format("[belt]\nmoving_mass_kg = {:.10g}\n", mass_kg)) +
         fmt::format("\n[skim]\nload_N = {:.10g}\n", specimen.skim_load_N);
}

/// The belt's force is known as well as a torque at a drum of 1 m radius.
const Machine machine{"flat_belt",
                      "rig.toml",
                      Measured::kTire,
                      false,
                      false,
                      false,
                      {columns::kTime, columns::kSpeed, columns::kLoad, columns::kAmbient},
                      {{"belt_force_N", "force", {0.45, 0.10, 60.0, 0.25, 0.0}}, columns::kLiner, columns::kPressure},
                      {},  // sets that are published are made again from their seeds
                      rig::gives,
                      rig::write_set_keys,
                      write_file,
                      draw_own,
                      draw_campaign,
                      calc_flat_factor,
                      find_unit_lever,
                      carriage::calc_moving_mass_kg};

}  // namespace rollrig::generator::flat_belt
