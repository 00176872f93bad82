#include "sim/energy_audit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/core/error.h"

namespace rollrig::sim {

double EnergyAudit::find_residual_J(EnergyTerm::Ledger ledger) const {
  double sum_J = 0.0;
  for (const EnergyTerm& term : terms) {
    if (term.ledger == ledger) sum_J += term.in_J;
  }
  return sum_J;
}

double EnergyAudit::find_largest_J() const {
  double largest_J = 0.0;
  for (const EnergyTerm& term : terms) largest_J = std::max(largest_J, std::abs(term.in_J));
  return largest_J;
}

double EnergyAudit::find_term_J(const std::string& name) const {
  for (const EnergyTerm& term : terms) {
    if (term.name == name) return term.in_J;
  }
  return 0.0;
}

double EnergyAudit::calc_closure(EnergyTerm::Ledger ledger) const {
  constexpr double kIdle = 1e-3;  // Assumed: a motor that did less than this share of the largest term stood
  const double largest_J = find_largest_J();
  const double scale_J = throughput_J > kIdle * largest_J ? throughput_J : largest_J;
  return scale_J > 0.0 ? std::abs(find_residual_J(ledger)) / scale_J : 0.0;
}

bool EnergyAudit::is_closed(double limit) const {
  return calc_closure(EnergyTerm::Ledger::kMechanical) <= limit && calc_closure(EnergyTerm::Ledger::kThermal) <= limit;
}

void EnergyAudit::require_closed(double limit) const {
  for (const auto& [ledger, name] :
       {std::pair{EnergyTerm::Ledger::kMechanical, "mechanical"}, std::pair{EnergyTerm::Ledger::kThermal, "thermal"}}) {
    const double closure = calc_closure(ledger);
    if (closure <= limit) continue;
    if (!std::isfinite(closure)) {
      throw RunFailure(
          "the run does not stay finite: values of the tire or of an effect are beyond what its steps can follow; "
          "nearer to the usual ones, or in the other fidelity, they may");
    }
    std::string text = fmt::format("the {} energy audit does not close: {:.3g} of the motor work, allowed {:.3g}", name,
                                   closure, limit);
    for (const EnergyTerm& term : terms) {
      if (term.ledger == ledger) text += fmt::format("\n  {:<24} {:>16.6f} J", term.name, term.in_J);
    }
    throw RunFailure(text);
  }
}

}  // namespace rollrig::sim
