#include "diagnosis/kinds/measurement_kind.h"

#include "diagnosis/kinds/kinds.h"
#include "sim/core/error.h"

namespace rollrig::diagnosis {

const MeasurementKind& kind_of(const scenarios::MeasurementSet& set) {
  switch (set.kind) {
    case scenarios::SetKind::kDrum:
      return drum_kind();
    case scenarios::SetKind::kDyno:
    case scenarios::SetKind::kRoad:
      break;
  }
  throw InputError({set.kind == scenarios::SetKind::kDyno ? "the set is of kind dyno, which is not diagnosed yet"
                                                          : "the set is of kind road, which is not diagnosed yet",
                    set.path, 0, "", "", "a set measured on a drum", ""});
}

}  // namespace rollrig::diagnosis
