#include "validation/generator/machine.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"

namespace rollrig::generator {

const std::vector<const Machine*>& all_machines() {
  static const std::vector<const Machine*> machines{
#define ROLLRIG_MACHINE(word) &word::machine,
#include "validation/generator/machines.def"
#undef ROLLRIG_MACHINE
  };
  return machines;
}

std::vector<std::string> machine_words() {
  std::vector<std::string> words;
  for (const Machine* machine : all_machines()) words.emplace_back(machine->word);
  return words;
}

const Machine& find_machine(const std::string& word, const char* key) {
  for (const Machine* machine : all_machines()) {
    if (word == machine->word) return *machine;
  }
  InputProblem problem = unknown_name("kind", word, machine_words());
  problem.key = key;
  throw InputError(problem);
}

bool everywhere(const Ground&) { return true; }
bool on_rigs(const Ground& ground) { return !ground.machine.has_vehicle(); }
bool on_carriages(const Ground& ground) { return ground.machine.force_of == Measured::kTire; }
bool on_rollers(const Ground& ground) { return ground.machine.force_of == Measured::kWheel; }
bool on_vehicles(const Ground& ground) { return !on_carriages(ground); }
bool on_roads(const Ground& ground) { return ground.machine.has_vehicle(); }
bool against_constant_law(const Ground& ground) { return ground.constant_rrc; }
bool against_combined_law(const Ground& ground) { return !ground.constant_rrc; }
bool off_reference_drum(const Ground& ground) {
  return against_combined_law(ground) && !ground.machine.is_near_reference_drum;
}

std::string list_grounds(Where where) {
  std::vector<std::string> names;
  for (const Machine* machine : all_machines()) {
    const char* law = machine->has_constant_law ? " (combined)" : "";
    if (where({*machine, false})) names.push_back(fmt::format("{}{}", machine->word, law));
    if (machine->has_constant_law && where({*machine, true})) {
      names.push_back(fmt::format("{} (constant_rrc)", machine->word));
    }
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

bool rig::gives(const Specimen&, Base which) { return which <= Base::kC2; }

std::string rig::write_set_keys(const Specimen&) { return "rig = \"rig.toml\"\n"; }

std::string rig::write_drum(const char* table, const Specimen& specimen) {
  return fmt::format("[{}]\ndiameter_m = {:.10g}\ninertia_kg_m2 = {:.10g}\n", table, specimen.drum_diameter_m,
                     specimen.drum_inertia_kg_m2);
}

std::string rig::write_file(const Specimen& specimen, int version, const std::string& body) {
  return fmt::format("format = \"rollrig-rig/{}\"\nname = \"laboratory\"\nkind = \"{}\"\n\n{}\n[parasitic]\n", version,
                     specimen.machine->word, body) +
         write_identified(specimen, Base::kC0, Base::kC2) +
         fmt::format("\n[environment]\nambient_degC = {:.10g}\n", specimen.ambient_degC);
}

double rig::calc_drum_factor(const Specimen& specimen) {
  const double tire_m = 0.5 * specimen.outer_diameter_m;
  const double here_m = 0.5 * specimen.drum_diameter_m;
  return std::sqrt((here_m + tire_m) / (here_m * (1.0 + tire_m)));
}

double calc_flat_factor(const Specimen& specimen) { return 1.0 / std::sqrt(1.0 + 0.5 * specimen.outer_diameter_m); }

double find_unit_lever(const Specimen&) { return 1.0; }

}  // namespace rollrig::generator
