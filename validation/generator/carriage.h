#pragma once
/// What kinds of machine have in common on which a carriage presses one tire: their runs, and what turns.

#include <vector>

#include "validation/generator/campaign.h"

namespace rollrig::generator::carriage {

/// A campaign of one of the laboratories in `kinds`, drawn by the seed of the order. The kinds of its runs are "warm-up
/// <km/h>", "speed steps", "load sweep", "transient skim" and "up and down".
Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen, const std::vector<CampaignKind>& kinds);

/// Machine::calc_moving_mass_kg: of the drum or belt, and of the wheel where it is not lifted.
double calc_moving_mass_kg(const Specimen& specimen, double load_N, double target_load_N);

}  // namespace rollrig::generator::carriage
