#include "blind/effect.h"

#include <cmath>

namespace blind {

#define ROLLRIG_BLIND_EFFECT(id) extern const EffectKind kind_##id;
#include "blind/effects.def"
#undef ROLLRIG_BLIND_EFFECT

const std::vector<const EffectKind*>& effect_kinds() {
  static const std::vector<const EffectKind*> kinds{
#define ROLLRIG_BLIND_EFFECT(id) &kind_##id,
#include "blind/effects.def"
#undef ROLLRIG_BLIND_EFFECT
  };
  return kinds;
}

const EffectKind* find_effect_kind(const std::string& id) {
  for (const EffectKind* kind : effect_kinds()) {
    if (id == kind->id) return kind;
  }
  return nullptr;
}

double warm_heating_W(const Specimen& specimen) {
  constexpr double kWarm_degC = 45.0;  // Assumed: a passenger-car tire after an hour
  if (specimen.constant_rrc) return 1e-3 * specimen.truth(Base::kRrc) * specimen.reference_load_N * kSpeed80_m_s;
  const double cold_N = specimen.truth(Base::kA0) + specimen.truth(Base::kA1) * kSpeed80_m_s;
  const double fall_per_K = specimen.truth(Base::kB0) + specimen.truth(Base::kB1) * kSpeed80_m_s;
  return cold_N * std::exp(-fall_per_K * kWarm_degC) * kSpeed80_m_s;
}

double draw_size(const EffectKind& kind, Draws& draws) {
  for (;;) {
    double size = draws.from(kind.size);
    if (kind.either_sign && draws.happens(0.5)) size = -size;
    if (std::isinf(kind.neutral) || std::abs(size - kind.neutral) >= kind.gap) return size;
  }
}

}  // namespace blind
