#pragma once
/// Runs a program on a system: phases, segments, events, samples, audits.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/interrupt.h"
#include "sim/core/scalar.h"
#include "sim/ode_system.h"
#include "sim/recording.h"

namespace rollrig::sim {

/// Called after each step with the share of the planned time that has passed, 0 to 1. The last value is below 1 if a
/// phase ends early.
using Progress = std::function<void(double done)>;

namespace detail {

/// Fills the rows of a recording as the integrator passes their times.
///
/// Samples lie at start + k d, d the program's interval, or at the program's own times. A row holds values
/// at its time, and for mean channels the mean from half-way to the sample before to half-way to the next,
/// cut at both ends of the run, or between the program's own bounds. At a knot the row shows the inputs that hold from
/// then on.
template <class S>
class Sampler {
 public:
  Sampler(OdeSystem<S>& system, const Program& program, Recording<S>& out)
      : system_(system),
        out_(out),
        program_(program),
        start_s_(program.start_time_s),
        interval_s_(program.sample_interval_s) {
    out_.channels = system.channels();
    out_.mean_bounds_s = program.mean_bounds_s;
    out_.values.resize(out_.channels.size());
    out_.poses = system.poses();
    out_.pose_values.resize(out_.poses.size());
    mean_start_.assign(system.integrals().size(), zero<S>());
    mean_end_.resize(mean_start_.size());
    state_.resize(system.state_count());
    for (const Channel& channel : out_.channels) instant_count_ += channel.is_mean() ? 0 : 1;
    instant_.resize(instant_count_);
    const std::size_t rows = estimate_rows();
    out_.time_s.reserve(rows);
    out_.phase.reserve(rows);
    for (std::vector<S>& column : out_.values) column.reserve(rows);
    for (auto& column : out_.pose_values) column.reserve(rows);
  }

  void begin_phase(const Phase& phase, std::size_t index, double phase_end_s) {
    stride_ = phase.row_stride;
    phase_index_ = index;
    first_of_phase_ = next_;
    skip_until_s_ = phase.until.has_value() ? start_s_ : phase_end_s - 2.0 * interval_s_;
  }

  /// Fills the rows that the last step of the integrator has reached; `segment_end_s` bounds row times.
  void follow(Integrator<S>& integrator, double segment_end_s) {
    if (!row_open_) pass_unwritten(std::min(integrator.time_s(), segment_end_s));
    while (true) {
      const double row_s = time_of(next_);
      if (!row_open_) {
        if (row_s >= segment_end_s - slack_at(next_) || row_s > integrator.time_s()) return;
        open_row(integrator, row_s);
      }
      const double upper_s = boundary_after(next_);
      if (upper_s > integrator.time_s()) return;
      close_row(integrator, upper_s);
    }
  }

  /// Rows that are still open or due at the very end.
  void finish(Integrator<S>& integrator) {
    const double end_s = integrator.time_s();
    if (!row_open_ && time_of(next_) <= end_s + slack_at(next_)) {
      std::copy(integrator.state(), integrator.state() + state_.size(), state_.begin());
      write_instants(time_of(next_));
      row_open_ = row_written_ = true;
    }
    if (!row_open_ || !row_written_) return;
    std::copy(integrator.integrals(), integrator.integrals() + mean_end_.size(), mean_end_.begin());
    write_means(end_s);
  }

 private:
  static constexpr double kMostSlack_s = 1e-9;
  static constexpr double kNever_s = 1e300;

  /// Without those of phases that may end before their time.
  std::size_t estimate_rows() const {
    if (!program_.sample_times_s.empty()) return program_.sample_times_s.size();
    double rows = 1.0;
    for (const Phase& phase : program_.phases) {
      if (!phase.until.has_value()) rows += std::ceil(phase.duration_s() / (interval_s_ * phase.row_stride));
    }
    return static_cast<std::size_t>(rows);
  }

  double time_of(long k) const {
    const std::vector<double>& times_s = program_.sample_times_s;
    if (times_s.empty()) return start_s_ + static_cast<double>(k) * interval_s_;
    return k < static_cast<long>(times_s.size()) ? times_s[static_cast<std::size_t>(k)] : kNever_s;
  }
  /// Tolerance for rounding: a sample that is so close to the end of a segment counts as at the end. At most a quarter
  /// of the distance to its neighbors, so that an end has one sample and none is left out.
  double slack_at(long k) const {
    const double before_s = k > 0 ? time_of(k) - time_of(k - 1) : kNever_s;
    return std::min(kMostSlack_s, 0.25 * std::min(before_s, time_of(k + 1) - time_of(k)));
  }
  double boundary_after(long k) const {
    const std::vector<double>& bounds_s = program_.mean_bounds_s;
    return bounds_s.empty() ? 0.5 * (time_of(k) + time_of(k + 1)) : bounds_s[static_cast<std::size_t>(k + 1)];
  }
  bool is_written(long k) const { return (k - first_of_phase_) % stride_ == 0; }

  /// Skips rows that are not written and at whose ends no mean needs the integrals. The mean of a written row begins at
  /// the end of the row before, so that this one is kept, and one more for rounding.
  void pass_unwritten(double until_s) {
    if (stride_ < 3 || !program_.sample_times_s.empty()) return;
    const long written = next_ + (stride_ - (next_ - first_of_phase_) % stride_) % stride_;
    const auto reached = static_cast<long>((std::min(until_s, skip_until_s_) - start_s_) / interval_s_);
    next_ = std::max(next_, std::min(written, reached) - 2);
  }

  void open_row(Integrator<S>& integrator, double row_s) {
    row_open_ = true;
    row_written_ = is_written(next_);
    if (!row_written_) return;
    if (instant_count_ > 0 || !out_.poses.empty()) integrator.interpolate_state(row_s, state_.data());
    write_instants(row_s);
  }

  void close_row(Integrator<S>& integrator, double upper_s) {
    if (row_written_ || is_written(next_ + 1) || upper_s > skip_until_s_) {
      integrator.interpolate_integrals(upper_s, mean_end_.data());
      if (row_written_) write_means(upper_s);
      std::swap(mean_start_, mean_end_);
    }
    row_open_ = false;
    ++next_;
  }

  void write_instants(double row_s) {
    out_.time_s.push_back(row_s);
    out_.phase.push_back(phase_index_);
    system_.observe(row_s, state_.data(), instant_.data());
    std::size_t next_instant = 0;
    for (std::size_t i = 0; i < out_.channels.size(); ++i) {
      out_.values[i].push_back(out_.channels[i].is_mean() ? zero<S>() : instant_[next_instant++]);
    }
    for (std::size_t i = 0; i < out_.poses.size(); ++i) out_.pose_values[i].push_back(state_[out_.poses[i].state]);
  }

  void write_means(double upper_s) {
    const double width_s = upper_s - (next_ > 0 ? boundary_after(next_ - 1) : start_s_);
    for (std::size_t i = 0; i < out_.channels.size(); ++i) {
      const std::size_t integral = out_.channels[i].integral;
      if (out_.channels[i].is_mean()) {
        out_.values[i].back() = (mean_end_[integral] - mean_start_[integral]) / width_s;
      }
    }
  }

  OdeSystem<S>& system_;
  Recording<S>& out_;
  const Program& program_;
  double start_s_;
  double interval_s_;
  std::size_t instant_count_ = 0;
  std::vector<S> mean_start_, mean_end_, state_, instant_;
  long next_ = 0;
  long first_of_phase_ = 0;
  bool row_open_ = false;
  bool row_written_ = false;
  int stride_ = 1;
  double skip_until_s_ = 0.0;  // before it, boundaries of rows that are not written need no integrals
  std::size_t phase_index_ = 0;
};

template <class S>
std::vector<S> subtract(const S* a, const std::vector<S>& b) {
  std::vector<S> difference(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

template <class S>
void require_possible(const OdeSystem<S>& system, Integrator<S>& integrator) {
  try {
    system.require_possible(integrator.state());
  } catch (const RunFailure& failure) {
    throw RunFailure("at t = " + std::to_string(integrator.time_s()) + " s " + failure.what());
  }
}

/// The two ledgers from what was stored before and after, and what was integrated.
template <class S>
EnergyAudit make_audit(const OdeSystem<S>& system, const std::vector<S>& stored_before,
                       const std::vector<S>& stored_after, const std::vector<S>& integrals) {
  using Ledger = EnergyTerm::Ledger;
  EnergyAudit audit;
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    const Integral& integral = system.integrals()[i];
    const double total_J = value_of(integrals[i]);
    switch (integral.role) {
      case Integral::Role::kChannel:
        break;
      case Integral::Role::kThroughput:
        audit.throughput_J = total_J;
        break;
      case Integral::Role::kWorkIn:
        audit.terms.push_back({integral.name, Ledger::kMechanical, total_J});
        break;
      case Integral::Role::kDissipated:
        audit.terms.push_back({integral.name, Ledger::kMechanical, -total_J});
        break;
      case Integral::Role::kHeatIn:
        audit.terms.push_back({integral.name, Ledger::kThermal, total_J});
        break;
      case Integral::Role::kHeatOut:
        audit.terms.push_back({integral.name, Ledger::kThermal, -total_J});
        break;
    }
  }
  for (std::size_t i = 0; i < system.stores().size(); ++i) {
    const Store& store = system.stores()[i];
    const Ledger ledger = store.role == Store::Role::kHeat ? Ledger::kThermal : Ledger::kMechanical;
    audit.terms.push_back({store.name, ledger, value_of(stored_before[i]) - value_of(stored_after[i])});
  }
  return audit;
}

}  // namespace detail

/// Runs `program` on `system` with `integrator`.
/// Errors  RunFailure when the integration fails or the system is in a state that it cannot have; Interrupted on
///         Ctrl-C. The recording contains the audits. The caller checks how well they close.
template <class S>
Recording<S> simulate(OdeSystem<S>& system, Integrator<S>& integrator, const Program& program,
                      const Progress& progress = {}) {
  Recording<S> out;
  const std::size_t integral_count = system.integrals().size();
  std::vector<S> stored_before(system.stores().size());
  std::vector<S> stored_after(stored_before.size());
  const double duration_s = program.duration_s();
  integrator.begin_run(program.start_time_s);
  system.initialize(program.phases.front().segments.front(), program.start_time_s, integrator.state());
  system.calc_stored(program.start_time_s, integrator.state(), stored_before.data());
  detail::Sampler<S> sampler(system, program, out);
  for (const Phase& phase : program.phases) {
    const double phase_start_s = integrator.time_s();
    const std::vector<S> integrals_before(integrator.integrals(), integrator.integrals() + integral_count);
    double planned_end_s = phase_start_s;
    bool stopped = false;
    log_phase(phase, phase_start_s);
    system.begin_phase(phase, phase_start_s, integrator.state());
    integrator.begin_phase();
    sampler.begin_phase(phase, out.phases.size(), phase_start_s + phase.duration_s());
    for (const Segment& segment : phase.segments) {
      planned_end_s += segment.duration_s;
      system.begin_segment(segment, integrator.time_s(), integrator.state(), integrator.integrals());
      integrator.begin_segment(
          segment.max_step_s > 0.0 ? std::min(segment.max_step_s, phase.max_step_s) : phase.max_step_s,
          phase.until.has_value() ? &*phase.until : nullptr);
      while (!stopped && integrator.time_s() < planned_end_s) {
        stopped = integrator.step(planned_end_s);
        detail::require_possible(system, integrator);
        sampler.follow(integrator, stopped ? integrator.time_s() : planned_end_s);
        throw_if_interrupted();
        if (progress) progress((integrator.time_s() - program.start_time_s) / duration_s);
      }
      if (stopped) break;
    }
    out.phases.push_back({phase.name, phase_start_s, integrator.time_s()});
    out.phase_integrals.push_back(detail::subtract(integrator.integrals(), integrals_before));
  }
  sampler.finish(integrator);
  system.calc_stored(integrator.time_s(), integrator.state(), stored_after.data());
  out.final_state.assign(integrator.state(), integrator.state() + system.state_count());
  out.final_integrals.assign(integrator.integrals(), integrator.integrals() + integral_count);
  out.audit = detail::make_audit(system, stored_before, stored_after, out.final_integrals);
  return out;
}

}  // namespace rollrig::sim
