#include "measurements/read_force.h"

#include <utility>

#include "rigs/trace_effects.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

/// What the effects of the port "trace" make of a true force in every row.
template <class S>
std::vector<S> trace_of(const MeasuredRun& run, const models::Corner<S>& corner, const Quantity& channel,
                        const std::vector<double>& force) {
  sim::Recording<S> recording;
  recording.time_s = run.time_s;
  recording.mean_bounds_s = run.mean_bounds_s;
  const auto add = [&](const Quantity& quantity, std::vector<S> values) {
    recording.channels.push_back({quantity});
    recording.values.push_back(std::move(values));
  };
  add(channel, {force.begin(), force.end()});
  for (const Quantity& quantity : {quantities::kLoad, quantities::kAmbient}) {
    if (!run.has(quantity)) continue;
    const std::vector<double>& given = run.column(quantity);
    add(quantity, {given.begin(), given.end()});
  }
  rigs::apply_trace_effects(corner, recording);
  return recording.values.front();
}

}  // namespace

const std::vector<double>* find_hung(const MeasuredRun& run) {
  for (const Quantity& quantity : {quantities::kHungTorque, quantities::kHungForce}) {
    if (run.has(quantity)) return &run.column(quantity);
  }
  return nullptr;
}

template <class S>
std::vector<S> read_force(const MeasuredRun& run, const models::Corner<S>& corner, std::vector<S> values,
                          const Quantity& channel) {
  const std::vector<double>* hung = find_hung(run);
  if (hung == nullptr && !run.reversed) return values;
  const std::vector<double> none(values.size(), 0.0);
  const std::vector<S> of_zero = trace_of(run, corner, channel, none);
  const std::vector<S> of_hung = trace_of(run, corner, channel, hung != nullptr ? *hung : none);
  for (std::size_t row = 0; row < values.size(); ++row) {
    values[row] += of_hung[row] - of_zero[row];
    if (run.reversed) values[row] -= S(2.0) * of_zero[row];
  }
  return values;
}

template std::vector<double> read_force(const MeasuredRun&, const models::Corner<double>&, std::vector<double>,
                                        const Quantity&);
template std::vector<Jet> read_force(const MeasuredRun&, const models::Corner<Jet>&, std::vector<Jet>, const Quantity&);

}  // namespace rollrig::measurements
