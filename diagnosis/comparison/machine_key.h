#pragma once
/// Base parameters of joined sets: those of the tire hold on all machines, those of a machine on it alone.

#include <cstddef>
#include <optional>
#include <string>

namespace rollrig::diagnosis {

/// "parasitic.c0_N of machine 1" is the parasitic.c0_N of the second machine (PreparedSet::source()); a key without a
/// machine holds on all.
struct MachineKey {
  std::string key;
  std::optional<std::size_t> machine;

  bool holds_on(std::size_t on) const { return !machine.has_value() || *machine == on; }
};

constexpr const char* kOfMachine = " of machine ";

inline std::string name_on_machine(const std::string& key, std::size_t machine) {
  return key + kOfMachine + std::to_string(machine);
}

inline MachineKey read_machine_key(const std::string& name) {
  const std::size_t at = name.find(kOfMachine);
  if (at == std::string::npos) return {name, std::nullopt};
  return {name.substr(0, at), std::stoul(name.substr(at + std::string(kOfMachine).size()))};
}

}  // namespace rollrig::diagnosis
