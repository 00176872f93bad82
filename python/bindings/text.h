#pragma once
/// Text of the library as str, and the other way round.

#include <pybind11/pybind11.h>

#include <string>

namespace rollrig::python {

/// Files of users may hold bytes that are no UTF-8: they become surrogates, as os.fsdecode() makes them.
inline pybind11::str to_str(const std::string& text) {
  PyObject* made = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::str>(made);
}

/// Text of a str (surrogates become the bytes again) or of bytes. Paths are bytes here (rollrig.settings). `argument`
/// stands in messages. Throws TypeError for what is none of them, and InputError for a lone surrogate or a NUL
/// character.
std::string to_string(pybind11::handle given, const std::string& argument);

/// A value as messages show it: its repr, or the start of a long one.
std::string show(pybind11::handle value);

/// "argument 'threads': a whole number is expected, not 'many'".
pybind11::type_error wrong_type(const std::string& argument, const std::string& expected, pybind11::handle given);

}  // namespace rollrig::python
