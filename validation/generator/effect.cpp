#include "validation/generator/effect.h"

#include <algorithm>
#include <cmath>

namespace rollrig::generator {

double RunStart::left_after_rest(double time_s, double pace) const {
  return rest_before_min.has_value() ? std::exp(-60.0 * *rest_before_min * pace / time_s) : 0.0;
}

double RunStart::recovered_in_rest(double time_s) const {
  return rest_before_min.has_value() ? -std::expm1(-60.0 * *rest_before_min / time_s) : 1.0;
}

const std::vector<const EffectKind*>& effect_kinds() {
  static const std::vector<const EffectKind*> kinds{
#define ROLLRIG_EFFECT(id) &id::kind,
#include "validation/generator/effects.def"
#undef ROLLRIG_EFFECT
  };
  return kinds;
}

const EffectKind* find_effect_kind(const std::string& id) {
  for (const EffectKind* kind : effect_kinds()) {
    if (id == kind->id) return kind;
  }
  return nullptr;
}

Effect make_effect(const Form& form, double size, Draws& draws, const Specimen& specimen) {
  Making making{size, draws, specimen};
  form.make(making);
  return std::move(making.effect);
}

const Form* find_form(const EffectKind& kind, const std::string& name) {
  for (const Form& form : kind.forms) {
    if (name == form.name) return &form;
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
    double size = draws.from(kind.size.drawn);
    if (kind.size.either_sign && draws.happens(0.5)) size = -size;
    if (std::isinf(kind.size.neutral) || std::abs(size - kind.size.neutral) >= kind.size.gap) return size;
  }
}

namespace {

double strength(const EffectKind& kind, double size) {
  return std::isinf(kind.size.neutral) ? 1.0 / std::abs(size) : std::abs(size - kind.size.neutral);
}

constexpr std::size_t kThird = 1000;

/// Many sizes, which are the same in each validation set, by strength.
std::vector<double> sort_sizes(const EffectKind& kind) {
  Draws draws(0, std::string("thirds/") + kind.id);
  std::vector<double> sizes(3 * kThird);
  for (double& one : sizes) one = draw_size(kind, draws);
  std::sort(sizes.begin(), sizes.end(), [&kind](double a, double b) { return strength(kind, a) < strength(kind, b); });
  return sizes;
}

/// Where the thirds meet.
std::array<double, 2> find_thirds(const EffectKind& kind) {
  const std::vector<double> sizes = sort_sizes(kind);
  return {strength(kind, sizes[kThird]), strength(kind, sizes[2 * kThird])};
}

}  // namespace

double typical_size(const EffectKind& kind, SizeClass wanted) {
  return sort_sizes(kind)[static_cast<std::size_t>(wanted) * kThird + kThird / 2];
}

double draw_size(const EffectKind& kind, SizeClass wanted, Draws& draws) {
  const std::array<double, 2> thirds = find_thirds(kind);
  for (;;) {
    const double size = draw_size(kind, draws);
    const double of = strength(kind, size);
    const SizeClass drawn =
        of < thirds[0] ? SizeClass::kSmall : (of < thirds[1] ? SizeClass::kMiddle : SizeClass::kLarge);
    if (drawn == wanted) return size;
  }
}

}  // namespace rollrig::generator
