#include "rollrig/fmu.h"

#include <fmt/format.h>

#include "exports/fmu_file.h"
#include "exports/wheel_of_tire.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"

namespace rollrig {

std::string make_fmu(const FmuInput& input) {
  if (input.fmi_version != 2 && input.fmi_version != 3) {
    throw InputError(
        {"unknown version of FMI", "", 0, "fmi_version", fmt::format("{}", input.fmi_version), "2 or 3", ""});
  }
  const models::TireFile tire = models::read_tire(read_config(find_asset("tires", input.tire)));
  const rigs::RigFile rig = rigs::read_rig(read_config(find_asset("rigs", input.rig)));
  return exports::make_fmu_file(exports::make_wheel_model(tire, rig, input.effects), {tire.name, tire.path},
                                {rig.name, rig.path}, input.fmi_version);
}

}  // namespace rollrig
