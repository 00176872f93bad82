/// One tire that a carriage presses on a drum. The motor's torque is measured.
#include <fmt/format.h>

#include "validation/generator/machine.h"

namespace rollrig::generator::drum {

/// Each has warm-ups, fast running, a load sweep, skims within a run, and a run at another pressure.
const std::vector<CampaignKind> kCampaigns{{"tire maker",
                                            {{"warm-up 80", "day-1"},
                                             {"transient skim", "day-1"},
                                             {"speed steps", "day-1"},
                                             {"load sweep", "day-2"},
                                             {"warm-up 120", "day-2"},
                                             {"warm-up 80", "day-2", 220}}},
                                           {"university",
                                            {{"warm-up 120", "day-1"},
                                             {"load sweep", "day-1", 0, 240},
                                             {"warm-up 40", "day-2"},
                                             {"transient skim", "day-2", 320},
                                             {"up and down", "day-3"},
                                             {"speed steps", "day-3", 0, 180}}},
                                           {"car maker",
                                            {{"speed steps", "day-1"},
                                             {"transient skim", "day-1", 0, 120},
                                             {"load sweep", "day-1"},
                                             {"warm-up 80", "day-2"},
                                             {"speed steps", "day-2", 240},
                                             {"warm-up 120", "day-2", 0, 150}}},
                                           {"test house",
                                            {{"warm-up 80", "day-1"},
                                             {"load sweep", "day-1"},
                                             {"load sweep", "day-2", 230},
                                             {"speed steps", "day-2"},
                                             {"transient skim", "day-3"},
                                             {"warm-up 130", "day-3"}}},
                                           {"institute",
                                            {{"up and down", "day-1"},
                                             {"warm-up 80", "day-1", 310},
                                             {"transient skim", "day-1", 0, 200},
                                             {"speed steps", "day-2"},
                                             {"load sweep", "day-2"},
                                             {"transient skim", "day-2", 250}}}};

void draw_own(std::uint64_t, Specimen&) {}

Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) {
  return carriage::draw_campaign(order, specimen, kCampaigns);
}

std::string write_file(const Specimen& specimen) {
  return rig::write_file(specimen, 1, rig::write_drum("drum", specimen)) +
         fmt::format("\n[skim]\nload_N = {:.10g}\n", specimen.skim_load_N);
}

double find_lever(const Specimen& specimen) { return 0.5 * specimen.drum_diameter_m; }

const Machine machine{
    "drum",
    "rig.toml",
    Measured::kTire,
    true,
    false,
    false,
    {columns::kTime, columns::kSpeed, columns::kLoad, columns::kAmbient},
    {{"drum_torque_Nm", "torque", {0.45, 0.10, 60.0, 0.25, 0.0}}, columns::kLiner, columns::kPressure},
    {{"full_drum", 6, ""}, {"short_drum", 3, ""}},
    rig::gives,
    rig::write_set_keys,
    write_file,
    draw_own,
    draw_campaign,
    rig::calc_drum_factor,
    find_lever,
    carriage::calc_moving_mass_kg};

}  // namespace rollrig::generator::drum
