#include <rollrig/version.h>

#include "bindings.h"
#include "call.h"

#include <cstdlib>

namespace rollrig::python {
namespace {

/// Lets glibc keep up to 4 MB of freed memory at the end of a heap, which a simulation needs again at once; page faults
/// take 5 % of a run otherwise. To that end it frees a block of 2 MB, after which glibc raises its limits itself, as
/// after any NumPy array of that size. A setting of the user, such as MALLOC_TRIM_THRESHOLD_, stays as it is.
void keep_small_freed_memory() {
  void* volatile block = std::malloc(2 << 20);
  std::free(block);
}

}  // namespace
}  // namespace rollrig::python

PYBIND11_MODULE(_rollrig, module) {
  using namespace rollrig::python;
  module.doc() = "The C++ API of rollrig as the package rollrig uses it; use the package instead.";
  module.attr("version") = rollrig::library_version();
  keep_small_freed_memory();
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_calls));
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
