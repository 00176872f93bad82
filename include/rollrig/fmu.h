#pragma once
/// A warm tire on its wheel as FMU, for simulators that import the Functional Mock-up Interface: docs/fmu.md.

#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

struct FmuInput {
  std::string tire;                  // name of an asset, or a path
  std::string rig = "road";          // what the tire rolls on: name of an asset, or a path
  std::vector<std::string> effects;  // ids of effects that are on; their sizes are parameters of the FMU
  int fmi_version = 2;               // 2 or 3
};

/// The bytes of the FMU, for this kind of machine (64-bit Linux). The same input gives the same bytes.
/// Example  write_folder("exported", {{"tire.fmu", make_fmu({"a50"})}});
/// Errors   InputError: no such tire, rig or effect; the tire lacks what the rig needs; an unknown version
std::string make_fmu(const FmuInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
