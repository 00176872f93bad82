#include "models/effect.h"

namespace rollrig::models {

// Named one by one, since the linker drops objects of a static library that nothing refers to.
#define ROLLRIG_EFFECT(id) \
  namespace id {           \
  const Effect& effect();  \
  }
#include "models/effects/effects.def"
#undef ROLLRIG_EFFECT

const std::vector<const Effect*>& all_effects() {
  static const std::vector<const Effect*> effects{
#define ROLLRIG_EFFECT(id) &id::effect(),
#include "models/effects/effects.def"
#undef ROLLRIG_EFFECT
  };
  return effects;
}

}  // namespace rollrig::models
