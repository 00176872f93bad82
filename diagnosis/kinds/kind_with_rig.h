#pragma once
/// What kinds of sets measured on a machine with a rig file have in common.

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

class KindWithRig : public MeasurementKind {
 public:
  Uncertainties find_uncertainties(const measurements::MeasurementSet& set,
                                   const models::Context<double>& context) const override {
    Uncertainties uncertainties;
    add_tire(set.tire, set.rig->thermal_name(), context, true, uncertainties);
    add_parasitic_loss(*set.rig, uncertainties);
    return uncertainties;
  }

  double usual_ambient_K(const measurements::MeasurementSet& set) const override {
    return set.rig->environment.ambient_K;
  }
};

}  // namespace rollrig::diagnosis
