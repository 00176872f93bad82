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

void fill(py::module_& module) {
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

/// The module. It is made once, since pybind11 keeps its types for the whole process. A subinterpreter is refused
/// before pybind11 is used: there pybind11 would wait forever for the GIL, which the waiting thread holds itself.
PyObject* make_module(PyObject*, PyModuleDef*) {
  if (PyInterpreterState_Get() != PyInterpreterState_Main()) {
    PyErr_SetString(PyExc_ImportError, "rollrig works in the main interpreter alone, not in a subinterpreter");
    return nullptr;
  }
  static PyObject* made = nullptr;
  try {
    if (made == nullptr) {
      auto module = py::reinterpret_steal<py::module_>(PyModule_New("rollrig._rollrig"));
      if (!module) return nullptr;
      fill(module);
      made = module.release().ptr();
    }
  } catch (py::error_already_set& error) {
    py::raise_from(error, PyExc_ImportError, "rollrig cannot be initialized");
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_ImportError, error.what());
  }
  Py_XINCREF(made);
  return made;
}

}  // namespace
}  // namespace rollrig::python

/// Written by hand: PYBIND11_MODULE would use pybind11 before the interpreter is checked, and Python would copy the
/// finished module into subinterpreters without a call that could refuse it.
extern "C" PYBIND11_EXPORT PyObject* PyInit__rollrig() {
  PYBIND11_CHECK_PYTHON_VERSION
  static PyModuleDef_Slot slots[] = {{Py_mod_create, reinterpret_cast<void*>(&rollrig::python::make_module)},
                                     {0, nullptr}};
  static PyModuleDef definition = {
      PyModuleDef_HEAD_INIT, "_rollrig", nullptr, 0, nullptr, slots, nullptr, nullptr, nullptr};
  return PyModuleDef_Init(&definition);
}
