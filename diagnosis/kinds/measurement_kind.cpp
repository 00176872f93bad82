#include "diagnosis/kinds/measurement_kind.h"

#include <map>

#include "diagnosis/kinds/kinds.h"

namespace rollrig::diagnosis {

const MeasurementKind& kind_of(const measurements::MeasurementSet& set) {
  static const std::map<std::string, const MeasurementKind*> kinds{
#define ROLLRIG_MACHINE(word) {#word, &word##_kind()},
#include "rigs/machines.def"
#undef ROLLRIG_MACHINE
  };
  return *kinds.at(set.kind->word);
}

}  // namespace rollrig::diagnosis
