#include "diagnosis/study.h"

namespace rollrig::diagnosis {

Study::Study(const measurements::MeasurementSet& measured, StudySettings with)
    : settings(std::move(with)),
      set(measured),
      base(find_base_parameters(set.source(), set.context(), settings.belief)),
      sd_sources(find_sd_sources(set.source(), set.context(), settings.belief)),
      discrepancy(set) {}

}  // namespace rollrig::diagnosis
