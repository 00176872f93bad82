#include <rollrig/error.h>

#include "bindings.h"
#include "text.h"

namespace rollrig::python {
namespace {

void raise_input_error(const InputError& error) {
  const InputProblem& problem = error.problem();
  const py::object type = py::module_::import("rollrig.errors").attr("InputError");
  const py::object raised =
      type(to_str(error.what()), to_str(problem.what), to_str(problem.file), problem.line, to_str(problem.key),
           to_str(problem.value), to_str(problem.allowed), to_str(problem.nearest));
  PyErr_SetObject(type.ptr(), raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise_input_error(error);
  } catch (const RunFailure& error) {
    const py::object type = py::module_::import("rollrig.errors").attr("RunFailure");
    PyErr_SetObject(type.ptr(), type(to_str(error.what())).ptr());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_local_exception_translator(&translate); }

}  // namespace rollrig::python
