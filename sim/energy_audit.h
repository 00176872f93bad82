#pragma once
/// Does energy close? Two ledgers a run, mechanical and thermal.

#include <string>
#include <vector>

namespace rollrig::sim {

struct EnergyTerm {
  enum class Ledger { kMechanical, kThermal };
  std::string name;
  Ledger ledger = Ledger::kMechanical;
  double in_J = 0.0;  // positive: brought in; negative: stored or carried out
};

/// Sums of what came in, what is stored and what went out; each ledger must sum to zero.
/// Equation  mechanical: work in - change of stored mechanical energy - dissipated = 0
///           thermal: heat in - change of stored heat - heat out = 0
/// Checked   tests/sim/energy_audit_test.cpp
struct EnergyAudit {
  std::vector<EnergyTerm> terms;
  double throughput_J = 0.0;  // work of the motor, driving and braking alike: the integral of |power|

  /// What is left over in a ledger [J].
  double find_residual_J(EnergyTerm::Ledger ledger) const;
  /// Magnitude of the largest term [J].
  double find_largest_J() const;
  /// The work of the named term [J]; 0 when there is none.
  double find_term_J(const std::string& name) const;
  /// |residual| / scale, where scale is the throughput of the motor (its net work would vanish for a
  /// lossless wheel that is run up and down again), or the largest term when it did next to nothing.
  double calc_closure(EnergyTerm::Ledger ledger) const;
  /// Whether both ledgers close to the limit.
  bool is_closed(double limit) const;
  /// Throws RunFailure, naming the ledger and every term of it, when a closure is above the limit.
  void require_closed(double limit) const;
};

/// The motor's term.
constexpr const char* kMotorWork = "motor";
/// Assumed: what closes to a millionth has no term missing; rounding and the steps of the integrators stay far below.
constexpr double kAuditLimit = 1e-6;

}  // namespace rollrig::sim
