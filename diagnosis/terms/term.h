#pragma once
/// Terms of hypotheses: what may be added to the baseline.

#include <optional>
#include <string>
#include <vector>

#include "models/effect.h"

namespace rollrig::diagnosis {

struct PreparedRun;

/// A term changes a simulated run by the ports of an effect (models/ports.h): input, losses, heat, and by the port
/// "trace" what its sensors record. Terms live as long as the program. A kind of terms is a file of this folder and its
/// line in term.cpp.
class Term {
 public:
  virtual ~Term() = default;

  /// Its name (`id`), own parameters with their priors, the size first, on which machines it acts, how wrong its law
  /// may be, and what is said of it.
  virtual const models::EffectInfo& info() const = 0;
  /// Its parameters: numbers that are known, then the own parameters.
  virtual const models::Effect& effect() const = 0;
  /// The known numbers in a run, SI units.
  virtual std::vector<double> list_known(const PreparedRun& /*run*/) const { return {}; }

  /// Of a family of unknown effects: what it is like with these own parameters, SI units: "a force of ... that ...".
  /// Nothing for a named effect.
  virtual std::optional<std::string> describe(const std::vector<double>& /*own_SI*/) const { return std::nullopt; }
  /// Of joined sets: whether it acts in the runs that were measured on a machine (PreparedRun::machine).
  virtual bool acts_on(std::size_t /*machine*/) const { return true; }
  /// Whether it stands for effects outside the catalog.
  virtual bool is_unknown() const { return false; }

  const std::string& name() const { return info().id; }
  const std::vector<models::EffectParameter>& parameters() const { return info().parameters; }
  std::size_t known_count() const { return effect().info.parameters.size() - parameters().size(); }
};

/// Every term that a comparison may try, in the order in which a hypothesis lists them, unknown effects last.
const std::vector<const Term*>& all_terms();
/// Names of those that are no unknown effects.
std::vector<std::string> term_names();

/// Named ones that act on such a machine with such a tire and can be seen there: of these the ones in `only` (all
/// where it is empty), less those in `without`.
std::vector<const Term*> choose_terms(const models::MachineTraits& machine, const models::TireModel& tire,
                                      const std::vector<std::string>& only, const std::vector<std::string>& without);

/// The families of unknown effects that act there.
std::vector<const Term*> choose_unknown_terms(const models::MachineTraits& machine, const models::TireModel& tire);

/// The named term of that name, or nullptr.
const Term* look_up_term(const std::string& name);
/// Throws InputError with the nearest known name.
const Term& find_term(const std::string& name);

}  // namespace rollrig::diagnosis
