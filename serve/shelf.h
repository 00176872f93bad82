#pragma once
/// What the page lets one choose: tires, rigs, vehicles, tests with their settings, effects. A request names one of
/// these and no path.

#include <map>
#include <string>
#include <vector>

#include "models/effect.h"
#include "scenarios/run/scenario.h"
#include "sim/core/json.h"

namespace rollrig::serve {

/// Files beside the assets, as the command line gives them.
struct ShelfFiles {
  std::vector<std::string> tires;
  std::vector<std::string> rigs;
  std::vector<std::string> vehicles;
};

class Shelf {
 public:
  /// Reads every file, so that a wrong one is said at the start. Throws InputError.
  explicit Shelf(const ShelfFiles& files);

  /// A name as a run takes it: of an asset, or the absolute path of a file of the command line. `kind` is "tire", "rig"
  /// or "vehicle". Throws InputError with the nearest name.
  const std::string& find(const std::string& kind, const std::string& name) const;

  /// {tires, rigs, vehicles, scenarios, effects}, with what a control of the page needs of each setting.
  Json make_choices() const;

 private:
  struct Item {
    std::string name;
    std::string path;  // as a run takes it
    std::string note;  // the designation of a tire, the kind of a rig
    const rigs::MachineKind* machine = nullptr;
  };

  const std::vector<Item>& items_of(const std::string& kind) const { return items_.at(kind); }
  Json make_scenario(const scenarios::Scenario& scenario) const;

  std::map<std::string, std::vector<Item>> items_;
};

/// Scenarios that the page offers: quasi-static, with no setting that has to be given.
bool is_offered(const scenarios::Scenario& scenario);

}  // namespace rollrig::serve
