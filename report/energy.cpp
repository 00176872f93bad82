#include "report/energy.h"

#include <fmt/format.h>

#include "report/blocks.h"

namespace rollrig::report {
namespace {

using Ledger = sim::EnergyTerm::Ledger;

Json make_ledger(const sim::EnergyAudit& audit, Ledger ledger, const char* name) {
  Json terms = Json::array();
  for (const sim::EnergyTerm& term : audit.terms) {
    if (term.ledger == ledger) terms.push_back({{"name", term.name}, {"in_J", rounded(term.in_J)}});
  }
  return {{"name", name}, {"terms", terms}};
}

}  // namespace

Block make_energy(const sim::EnergyAudit& audit) {
  return {
      {"type", "energy"},
      {"ledgers",
       {make_ledger(audit, Ledger::kMechanical, "mechanical work"),
        make_ledger(audit, Ledger::kThermal, "heat in the tire")}},
      {"links", Json::array({Json::array({"tire_loss", "heat_generated"})})},
      {"caption", fmt::format("From left to right: what brings energy in, and where it goes or stays. The mechanical "
                              "balance closes to {:.1e} of the work, the thermal one to {:.1e}. Terms below 0.1 % "
                              "of the inflow stand in the table alone.",
                              audit.calc_closure(Ledger::kMechanical), audit.calc_closure(Ledger::kThermal))}};
}

}  // namespace rollrig::report
