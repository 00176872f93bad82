#pragma once
/// Text of the library as str.

#include <pybind11/pybind11.h>

#include <string>

namespace rollrig::python {

/// Files of users may hold bytes that are no UTF-8: they become surrogates, as os.fsdecode() makes them.
inline pybind11::str to_str(const std::string& text) {
  PyObject* made = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::str>(made);
}

}  // namespace rollrig::python
