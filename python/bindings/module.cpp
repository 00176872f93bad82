#include <rollrig/version.h>

#include "bindings.h"

PYBIND11_MODULE(_rollrig, module) {
  using namespace rollrig::python;
  module.doc() = "The C++ API of rollrig as the package rollrig uses it; use the package instead.";
  module.attr("version") = rollrig::library_version();
  bind_errors(module);
  bind_report(module);
  bind_run(module);
  bind_sweep(module);
  bind_campaign(module);
  bind_sets(module);
  bind_diagnose(module);
  bind_fits(module);
  bind_new(module);
  bind_assets(module);
  bind_results(module);
}
