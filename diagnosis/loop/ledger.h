#pragma once
/// loop.json: what a loop of tests has done.

#include <string>

#include "include/rollrig/loop.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

using rollrig::LoopAnswer, rollrig::LoopLedger, rollrig::LoopState, rollrig::LoopTest, rollrig::LoopTestState;

/// Hours of the machine that the tests so far took, failed ones included.
double calc_hours_used(const LoopLedger& ledger);

/// rollrig-loop/1
Json make_ledger_json(const LoopLedger& ledger);
/// Throws InputError for a file that is not such a ledger.
LoopLedger read_ledger(const std::string& file);

/// For a terminal: a row each answer, what was named, what was planned.
std::string format_ledger(const LoopLedger& ledger);

}  // namespace rollrig::diagnosis
