/// Sets measured on a flat belt.
#include <algorithm>

#include <boost/algorithm/string/replace.hpp>

#include "diagnosis/kinds/tire_rig.h"

namespace rollrig::diagnosis {
namespace {

class FlatBeltKind : public TireRigKind {
 public:
  FlatBeltKind() : TireRigKind(rigs::find_machine_kind("flat_belt").traits.force, {"belt force", "belt force", "kN"}) {}

  /// As on a drum, but for weights on a lever, which need an axis.
  std::vector<PlannedTest> make_test_menu(const PreparedSet& set) const override {
    std::vector<PlannedTest> menu = TireRigKind::make_test_menu(set);
    menu.erase(
        std::remove_if(menu.begin(), menu.end(), [](const PlannedTest& test) { return test.id == "dead_weights"; }),
        menu.end());
    for (PlannedTest& test : menu) {
      put_words(test.description);
      for (std::string& step : test.by_hand) put_words(step);
    }
    return menu;
  }

 private:
  static void put_words(std::string& text) {
    boost::replace_all(text, "drum", "belt");
    boost::replace_all(text, "torque", "force");
  }
};

}  // namespace

const MeasurementKind& flat_belt_kind() {
  static const FlatBeltKind kind;
  return kind;
}

}  // namespace rollrig::diagnosis
