#pragma once
/// A warm tire on its wheel as FMU, for simulators that import the Functional Mock-up Interface: docs/fmu.md.

#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

struct FmuInput {
  std::string tire;                  // name of an asset, or a path
  std::string rig = "road";          // what the tire rolls on: name of an asset, or a path
  std::vector<std::string> effects;  // ids of effects that are on; their numbers are parameters of the FMU
  int fmi_version = 2;               // 2 or 3
};

/// The bytes of the FMU, which runs on Linux on x86-64 with glibc 2.36 or newer (Debian 12). It needs no other library
/// and no file, and rollrig need not be installed. The same files and input give the same bytes, from the same version
/// of rollrig.
/// Example   write_folder("exported", {{"tire.fmu", make_fmu({"a50"})}});
/// Equation  docs/physics.md, DrivenWheel
/// Validity  docs/fmu.md#validity
/// Errors    InputError: no such tire, rig or effect; an effect that changes nothing of this tire on this rig; the tire
///           lacks what the rig needs; an unknown version
std::string make_fmu(const FmuInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
