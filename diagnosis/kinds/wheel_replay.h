#pragma once
/// Runs of a vehicle's wheel, on a roller or on the road, for the diagnosis.

#include <vector>

#include "diagnosis/kinds/measurement_kind.h"
#include "scenarios/wheel_replay.h"

namespace rollrig::diagnosis {

/// A run whose intervals are made once and simulated by one of the functions of scenarios/wheel_replay.h. Those
/// record the measured channels alone, whatever the detail.
class WheelReplay : public RunReplay {
 public:
  template <class S>
  using Function = sim::Recording<S> (*)(const scenarios::MeasurementSet&, const scenarios::MeasuredRun&,
                                         const std::vector<scenarios::WheelInterval>&, models::Corner<S>&,
                                         scenarios::ReplayObserver<S>*);

  WheelReplay(const scenarios::MeasuredRun& run, Function<double> plain, Function<Jet> derived)
      : intervals_(scenarios::make_wheel_intervals(run)), plain_(plain), derived_(derived) {}

  sim::Recording<double> simulate(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run,
                                  models::Corner<double>& corner, rigs::Detail) const override {
    return plain_(set, run, intervals_, corner, nullptr);
  }
  sim::Recording<Jet> simulate(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run,
                               models::Corner<Jet>& corner, rigs::Detail) const override {
    return derived_(set, run, intervals_, corner, nullptr);
  }

 private:
  std::vector<scenarios::WheelInterval> intervals_;
  Function<double> plain_;
  Function<Jet> derived_;
};

}  // namespace rollrig::diagnosis
