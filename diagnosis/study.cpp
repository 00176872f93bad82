#include "diagnosis/study.h"

#include "diagnosis/comparison/base_parameters.h"

namespace rollrig::diagnosis {

Study::Study(const measurements::MeasurementSet& measured, StudySettings with)
    : settings(std::move(with)),
      set(measured),
      base(find_base_parameters(set.source(), set.context())),
      discrepancy(set) {}

}  // namespace rollrig::diagnosis
