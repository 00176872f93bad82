#pragma once
/// From what a program gives to a run as scenarios know it.

#include "rollrig/run.h"
#include "scenarios/run/run_spec.h"

namespace rollrig::api {

/// Reads what `input` names. Throws InputError.
scenarios::RunSpec read_run(const RunInput& input);

}  // namespace rollrig::api
