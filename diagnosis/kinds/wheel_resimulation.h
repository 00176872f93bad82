#pragma once
/// Runs of a vehicle's wheel, on a roller or on the road, for the diagnosis.

#include <vector>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/wheel_replay.h"

namespace rollrig::diagnosis {

/// A run whose intervals are made once and simulated by one of the functions of measurements/wheel_replay.h. Those
/// record the measured channels alone, whatever the detail.
class WheelResimulation : public Resimulation {
 public:
  template <class S>
  using Function = sim::Recording<S> (*)(const measurements::MeasurementSet&, const measurements::MeasuredRun&,
                                         const std::vector<measurements::WheelInterval>&, models::Corner<S>&,
                                         measurements::ReplayObserver<S>*);

  WheelResimulation(const measurements::MeasuredRun& run, Function<double> plain, Function<Jet> derived)
      : intervals_(measurements::make_wheel_intervals(run)), plain_(plain), derived_(derived) {}

  sim::Recording<double> simulate(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                                  models::Corner<double>& corner, rigs::Detail) const override {
    return plain_(set, run, intervals_, corner, nullptr);
  }
  sim::Recording<Jet> simulate(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                               models::Corner<Jet>& corner, rigs::Detail) const override {
    return derived_(set, run, intervals_, corner, nullptr);
  }

 private:
  std::vector<measurements::WheelInterval> intervals_;
  Function<double> plain_;
  Function<Jet> derived_;
};

}  // namespace rollrig::diagnosis
