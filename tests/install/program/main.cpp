// A program of somebody else's: an ISO 28580 test through the installed library.
#include <fmt/format.h>

#include "scenarios/run/run_spec.h"
#include "sim/core/error.h"

int main() {
  namespace scenarios = rollrig::scenarios;
  try {
    rollrig::ConfigTable document = scenarios::make_run_document("iso_28580");
    rollrig::set_config_value(document, "tire", "a50", "program");
    const scenarios::RunSpec spec = scenarios::read_run_spec(document, "");
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, nullptr);
    const rollrig::Json result = scenarios::make_result_json(spec, outcome);
    fmt::print("{}\n{}\n", result["result"]["rrc_25degC_2m_N_per_kN"].get<double>(), spec.tire.path);
  } catch (const rollrig::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
