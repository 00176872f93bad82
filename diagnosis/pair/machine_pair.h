#pragma once
/// Finds the effect in which two machines differ. Both tested the same tire.

#include "include/rollrig/findings.h"
#include "include/rollrig/machine_pair.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// Compares hypotheses on the joined runs of both sets. The numbers of the tire are common to both, and what the tire
/// does beyond its law is as well, so that only what acts on one machine alone can make them differ.
/// Method  docs/machine_pairs.md
/// Errors  InputError: another tire or kind of machine; the same set twice; a set of the road; an unknown effect
/// Checked tests/diagnosis/machine_pair_test.cpp
rollrig::PairFindings diagnose_pair(const measurements::MeasurementSet& a, const measurements::MeasurementSet& b,
                                    const rollrig::DiagnosisOptions& options);

}  // namespace rollrig::diagnosis
