#include "text.h"

#include <rollrig/error.h>

namespace rollrig::python {
namespace {

pybind11::bytes encode(pybind11::handle text, const char* errors) {
  PyObject* made = PyUnicode_AsEncodedString(text.ptr(), "utf-8", errors);
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::bytes>(made);
}

InputError bad_text(const std::string& argument, const std::string& what, const std::string& allowed,
                    pybind11::handle given) {
  return InputError({"argument '" + argument + "' has a " + what, "", 0, argument, show(given), allowed, ""});
}

pybind11::bytes to_bytes(pybind11::handle given, const std::string& argument) {
  try {
    return encode(given, "surrogateescape");
  } catch (const pybind11::error_already_set&) {
    throw bad_text(argument, "lone surrogate", "text in Unicode", given);
  }
}

}  // namespace

std::string to_string(pybind11::handle given, const std::string& argument) {
  const bool is_str = PyUnicode_Check(given.ptr()) != 0;
  if (is_str || PyBytes_Check(given.ptr()) != 0) {
    const auto bytes = is_str ? to_bytes(given, argument) : pybind11::reinterpret_borrow<pybind11::bytes>(given);
    const auto text = static_cast<std::string>(bytes);
    if (text.find('\0') == std::string::npos) return text;
    throw bad_text(argument, "NUL character", "text without one", given);
  }
  throw wrong_type(argument, "a text is expected", given);
}

std::string show(pybind11::handle value) {
  const pybind11::object shown = pybind11::module_::import("rollrig.settings").attr("show")(value);
  return static_cast<std::string>(encode(shown, "backslashreplace"));
}

pybind11::type_error wrong_type(const std::string& argument, const std::string& expected, pybind11::handle given) {
  return pybind11::type_error("argument '" + argument + "': " + expected + ", not " + show(given));
}

}  // namespace rollrig::python
