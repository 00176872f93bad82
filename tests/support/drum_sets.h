#pragma once
/// Campaigns on the drum as measurement sets, with effects and the noise of the source's sensors.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "models/effect.h"
#include "tests/support/drum_fixture.h"

namespace rollrig::tests {

/// One scenario of a campaign; all its runs go into the set, as "<part>-<run>".
struct CampaignPart {
  std::string scenario;
  std::vector<std::string> settings;
};

struct Campaign {
  std::string tire = combined_tire_path();  // a file
  std::vector<CampaignPart> parts;
  std::vector<models::ActiveEffect> effects;
};

/// Short: two warm-ups with skims, at 80 and 120 km/h, and skims spread over a third.
Campaign make_short_campaign();
/// Wide: also three loads and three pressures.
Campaign make_wide_campaign();

/// The campaign simulated quasi-statically, with noise of a seed; sensors of assets/sensors/source.toml.
measurements::MeasurementSet simulate_campaign(const Campaign& campaign, std::uint64_t seed = 1);

/// An effect with all parameters at the lower or upper end of their priors, or between (0 to 1).
models::ActiveEffect make_effect_at(const std::string& id, double between);

}  // namespace rollrig::tests
