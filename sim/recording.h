#pragma once
/// What a run leaves behind.

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/energy_audit.h"
#include "sim/ode_system.h"

namespace rollrig::sim {

struct PhaseSpan {
  std::string name;
  double start_s = 0.0;
  double end_s = 0.0;
};

template <class S>
struct Recording {
  std::vector<Channel> channels;
  std::vector<PhaseSpan> phases;
  std::vector<std::vector<S>> phase_integrals;  // of each phase: what its time added to every integral
  std::vector<double> time_s;
  std::vector<double> mean_bounds_s;        // where the mean of each row begins and that of the last ends; may be empty
  std::vector<std::size_t> phase;           // index into phases, one a row
  std::vector<std::vector<S>> values;       // one column a channel, SI units
  std::vector<PoseCoordinate> poses;        // of the bodies, where the system has some
  std::vector<std::vector<S>> pose_values;  // one column a pose, SI units, at the rows' times
  std::vector<S> final_state;
  std::vector<S> final_integrals;
  EnergyAudit audit;

  std::size_t row_count() const { return time_s.size(); }

  /// nullptr for a channel that was not recorded.
  const std::vector<S>* find(const Quantity& quantity) const {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].quantity == quantity) return &values[i];
    }
    return nullptr;
  }
  /// Throws std::invalid_argument for a channel that was not recorded.
  const std::vector<S>& channel(const Quantity& quantity) const {
    if (const std::vector<S>* found = find(quantity)) return *found;
    throw std::invalid_argument("no channel '" + quantity.header() + "' was recorded");
  }
  std::vector<S>& channel(const Quantity& quantity) {
    return const_cast<std::vector<S>&>(static_cast<const Recording&>(*this).channel(quantity));
  }
  /// By its heading in files.
  const std::vector<S>& channel(const std::string& header) const { return channel(intern_quantity(header)); }

  /// The first row at or after a time, or the last row.
  std::size_t row_at(double at_s) const {
    constexpr double kSlack_s = 1e-9;
    const auto row = std::lower_bound(time_s.begin(), time_s.end(), at_s - kSlack_s);
    return std::min(static_cast<std::size_t>(row - time_s.begin()), time_s.size() - 1);
  }

  const PhaseSpan& phase_named(const std::string& name) const {
    for (const PhaseSpan& span : phases) {
      if (span.name == name) return span;
    }
    throw std::invalid_argument("no phase '" + name + "' was run");
  }
};

}  // namespace rollrig::sim
