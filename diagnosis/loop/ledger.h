#pragma once
/// loop.json: what a loop of tests has done.

#include <string>

#include "include/rollrig/loop.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

using rollrig::LoopAnswer, rollrig::LoopLedger, rollrig::LoopState, rollrig::LoopTest, rollrig::LoopTestState;

/// Hours of the machine that the tests so far took, with failed ones, without one that is only planned.
double calc_hours_used(const LoopLedger& ledger);

/// rollrig-loop/1
Json make_ledger_json(const LoopLedger& ledger);
/// Throws InputError for a file that is not such a ledger.
LoopLedger read_ledger(const std::string& file);

/// For a terminal: a table with a row for each answer: the test before it, verdict, probability and cause.
std::string format_ledger(const LoopLedger& ledger);

}  // namespace rollrig::diagnosis
