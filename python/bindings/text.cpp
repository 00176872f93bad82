#include "text.h"

#include <rollrig/error.h>

namespace rollrig::python {
namespace {

pybind11::bytes to_bytes(pybind11::handle given, const std::string& argument) {
  PyObject* made = PyUnicode_AsEncodedString(given.ptr(), "utf-8", "surrogateescape");
  if (made != nullptr) return pybind11::reinterpret_steal<pybind11::bytes>(made);
  PyErr_Clear();
  throw InputError({"argument '" + argument + "' holds half of a character", "", 0, argument,
                    pybind11::repr(given).cast<std::string>(), "text in Unicode", ""});
}

}  // namespace

std::string to_string(pybind11::handle given, const std::string& argument) {
  if (PyUnicode_Check(given.ptr()) != 0) return to_string(to_bytes(given, argument), argument);
  if (PyBytes_Check(given.ptr()) != 0) {
    const auto text = static_cast<std::string>(pybind11::reinterpret_borrow<pybind11::bytes>(given));
    if (text.find('\0') == std::string::npos) return text;
    throw InputError({"argument '" + argument + "' holds a zero", "", 0, argument,
                      pybind11::repr(given).cast<std::string>(), "text without one", ""});
  }
  PyObject* path = PyOS_FSPath(given.ptr());
  if (path != nullptr) return to_string(pybind11::reinterpret_steal<pybind11::object>(path), argument);
  PyErr_Clear();
  throw pybind11::type_error("argument '" + argument + "': a text or a path is expected, not " +
                             Py_TYPE(given.ptr())->tp_name);
}

}  // namespace rollrig::python
