#include <rollrig/assets.h>

#include "arrays.h"
#include "bindings.h"
#include "text.h"

namespace rollrig::python {
namespace {

/// Sentences by name.
py::dict list_sentences(const std::vector<Listed>& listed) {
  py::dict dict;
  for (const Listed& at : listed) dict[to_str(at.name)] = to_str(at.summary);
  return dict;
}

}  // namespace

void bind_assets(py::module_& module) {
  module.def("list_scenarios", [] { return list_sentences(list_scenarios()); });
  module.def("list_effects", [] { return list_sentences(list_effects()); });
  module.def("list_assets", [](const py::object& folder) { return to_list(list_assets(to_string(folder, "folder"))); });
  module.def("find_asset", [](const py::object& folder, const std::string& name) {
    return to_str(find_asset(to_string(folder, "folder"), name));
  });
  module.def("find_assets_folder", [] { return to_str(find_assets_folder()); });
  module.def("describe", [](const std::string& name) { return to_str(describe(name)); });
}

}  // namespace rollrig::python
