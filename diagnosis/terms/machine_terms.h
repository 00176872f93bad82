#pragma once
/// What may act on one of two machines that test the same tire.

#include <string>
#include <vector>

#include "diagnosis/terms/term.h"

namespace rollrig::diagnosis {

/// An effect that acts in the runs of one machine alone. It is either an effect of the catalog that belongs to a
/// machine, or one of those that only a second machine shows, because on one machine alone they look like the tire's:
/// its surface, the diameter of its drum, and its thermometers.
class MachineTerm : public Term {
 public:
  MachineTerm(const models::Effect& effect, std::size_t machine);

  const models::EffectInfo& info() const override { return info_; }
  const models::Effect& effect() const override { return effect_; }
  bool acts_on(std::size_t machine) const override { return machine == machine_; }

  /// The effect's own name: "bearing_warmup" of "bearing_warmup on A".
  const std::string& effect_name() const { return effect_.info.id; }
  std::size_t machine() const { return machine_; }

 private:
  const models::Effect& effect_;
  std::size_t machine_;
  models::EffectInfo info_;  // with the machine in its name
};

/// "A" or "B", the first and the second machine.
const char* letter_of_machine(std::size_t machine);

/// Whether an effect of the catalog belongs to the tire, so that it acts on all machines alike.
bool belongs_to_tire(const std::string& effect);

/// Effects that only a second machine shows: surface_roughness, drum_diameter, ambient_record, liner_record.
/// Checked  tests/diagnosis/machine_terms_test.cpp
const std::vector<const models::Effect*>& effects_between_machines();

/// Names of the effects in which two machines may differ, sorted.
std::vector<std::string> machine_effect_names();

/// All terms of one machine, those of the first before those of the second.
const std::vector<const MachineTerm*>& all_machine_terms();

/// As choose_terms(), on one machine each.
std::vector<const Term*> choose_machine_terms(const models::MachineTraits& machine, const models::TireModel& tire,
                                              const std::vector<std::string>& only,
                                              const std::vector<std::string>& without);

}  // namespace rollrig::diagnosis
