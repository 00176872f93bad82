#include <rollrig/error.h>

#include <filesystem>

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

/// A place that the operating system does not let one look at, as the command line says it.
InputError make_input_error(const std::filesystem::filesystem_error& error) {
  const std::string path = error.path1().string();
  return InputError(
      {"cannot access " + (path.empty() ? "the working folder" : "'" + path + "'") + ": " + error.code().message(), "",
       0, "", "", "a place that can be read and searched", ""});
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise_input_error(error);
  } catch (const RunFailure& error) {
    const py::object type = py::module_::import("rollrig.errors").attr("RunFailure");
    PyErr_SetObject(type.ptr(), type(to_str(error.what())).ptr());
  } catch (const std::filesystem::filesystem_error& error) {
    raise_input_error(make_input_error(error));
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_local_exception_translator(&translate); }

}  // namespace rollrig::python
