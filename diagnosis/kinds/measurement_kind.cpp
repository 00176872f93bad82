#include "diagnosis/kinds/measurement_kind.h"

#include <stdexcept>

#include "diagnosis/kinds/kinds.h"

namespace rollrig::diagnosis {

const MeasurementKind& kind_of(const measurements::MeasurementSet& set) {
  switch (set.kind) {
    case measurements::SetKind::kDrum:
      return drum_kind();
    case measurements::SetKind::kDyno:
      return dyno_kind();
    case measurements::SetKind::kRoad:
      return road_kind();
  }
  throw std::invalid_argument("a kind of set without an entry here");
}

}  // namespace rollrig::diagnosis
