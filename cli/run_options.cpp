#include "cli/run_options.h"

namespace rollrig::cli {

void add_run_options(CLI::App& command, RunInput& input) {
  command.add_option("scenario", input.scenario_or_file, "Scenario name, or a run file (.toml)")->required();
  command.add_option("--tire", input.tire, "Name under assets/tires, or a path");
  command.add_option("--rig", input.rig, "Name under assets/rigs, or a path [the scenario's]");
  command.add_option("--vehicle", input.vehicle, "Name under assets/vehicles, or a path [source_car]");
  command.add_option("--fidelity", input.fidelity, "multibody or quasi_static [multibody]");
  command.add_option("--baseline", input.baseline, "combined or constant_rrc [combined]");
  command.add_option("--sensors", input.sensors, "Virtual sensors: a name under assets/sensors, a path, or none");
  command.add_option("--seed", input.seed, "Seed of the sensors' random numbers [1]");
  command
      .add_option("--set", input.settings,
                  "key=value: a setting of the scenario, or tire.<table>.<key>, rig.<table>.<key>, "
                  "vehicle.<table>.<key>, effects.<id>.<parameter>; may be repeated")
      ->expected(1)
      ->take_all();
}

}  // namespace rollrig::cli
