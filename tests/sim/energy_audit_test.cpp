#include "sim/energy_audit.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/core/error.h"

using namespace rollrig;
using sim::EnergyAudit;
using Ledger = sim::EnergyTerm::Ledger;

TEST_CASE("a ledger that sums to zero is closed, on the scale of the motor's work", "[fast]") {
  EnergyAudit audit;
  audit.terms = {{sim::kMotorWork, Ledger::kMechanical, 1000.0},
                 {"loss", Ledger::kMechanical, -999.0},
                 {"kinetic", Ledger::kMechanical, -1.0},
                 {"heat_generated", Ledger::kThermal, 999.0},
                 {"heat_to_air", Ledger::kThermal, -998.0}};
  CHECK(audit.calc_closure(Ledger::kMechanical) == 0.0);
  CHECK(audit.calc_closure(Ledger::kThermal) == Approx(1e-3));
  CHECK_NOTHROW(audit.require_closed(2e-3));
  CHECK_THROWS_WITH(audit.require_closed(1e-4), Catch::Contains("thermal") && Catch::Contains("heat_to_air"));
}

TEST_CASE("without motor work the largest term is the scale, and nothing at all is closed", "[fast]") {
  EnergyAudit audit;
  CHECK(audit.calc_closure(Ledger::kThermal) == 0.0);
  audit.terms = {{"heat_to_air", Ledger::kThermal, -50.0}, {"stored_heat", Ledger::kThermal, 49.0}};
  CHECK(audit.calc_closure(Ledger::kThermal) == Approx(0.02));
}

TEST_CASE("next to no motor work is no scale", "[fast]") {
  EnergyAudit audit;
  audit.throughput_J = 1e-6;  // a motor that holds
  audit.terms = {{"load_actuator", Ledger::kMechanical, 40.0}, {"tire_spring", Ledger::kMechanical, -39.999}};
  CHECK(audit.calc_closure(Ledger::kMechanical) == Approx(2.5e-5));
  CHECK_THROWS_AS(audit.require_closed(1e-6), RunFailure);
}

TEST_CASE("a ledger with NaN is not closed", "[fast]") {
  EnergyAudit audit;
  audit.terms = {{sim::kMotorWork, Ledger::kMechanical, 1.0}, {"loss", Ledger::kMechanical, std::nan("")}};
  CHECK_THROWS_AS(audit.require_closed(1.0), RunFailure);
}
