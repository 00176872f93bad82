#pragma once
/// The pages of `rollrig diagnose`, and their sections that follow from the diagnosis alone.

#include "diagnosis/diagnosis.h"
#include "diagnosis/output/fleet.h"
#include "include/rollrig/loop.h"
#include "report/page.h"

namespace rollrig::report {

/// Verdict in a sentence, causes with their probabilities, gap before and after on held-out runs, gap map, what cannot
/// be told apart and the test that would, equation and source of what is named, measurement and simulation by run.
Page make_diagnosis_page(const measurements::MeasurementSet& set, const diagnosis::Diagnosis& diagnosis);

/// Name of an effect, of "none" or of "unknown", as pages show it: "bearing warmup".
std::string name_effect(const std::string& id);
/// The verdict in one sentence: "Explained: the gap is bearing warmup (probability 94 %)."
std::string describe_verdict(const Findings& findings);
Section make_verdict(const Findings& findings);
Section make_causes(const Findings& findings);
Section make_base_numbers(const Findings& findings);
Section make_gap(const Findings& findings);
/// What each step from the files' numbers to the first cause takes: of the force's gap in N, and over all channels in
/// noise floors. Empty where the steps are not known.
std::vector<Block> make_gap_waterfalls(const Gap& gap);
Block make_balance(const Findings& findings);
Section make_next(const Findings& findings);
/// Equation, source, priors of what is named and of what cannot be told from it.
Section make_explanations(const Findings& findings);

/// The ledger of a loop of tests: probabilities over the hours of the machine, and what each answer was.
Section make_loop_section(const LoopLedger& ledger);
/// Adds a loop of tests to the page of its last diagnosis: to the verdict what the loop has done and what comes next,
/// and after it the ledger.
void add_loop(const LoopLedger& ledger, Page& page);

/// A folder of sets: a row each, and what comes back.
Page make_fleet_page(const diagnosis::Fleet& fleet);

}  // namespace rollrig::report
