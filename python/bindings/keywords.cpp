#include "keywords.h"

namespace rollrig::python {

bool is_bool(py::handle given) {
  if (PyBool_Check(given.ptr()) != 0) return true;
  const std::string type = Py_TYPE(given.ptr())->tp_name;
  return type == "numpy.bool_" || type == "numpy.bool";  // of NumPy 1 and 2
}

bool has_bool(py::handle given, int levels) {
  const bool is_list = PySequence_Check(given.ptr()) != 0 && PyUnicode_Check(given.ptr()) == 0;
  if (levels == 0 || !is_list || PySequence_Size(given.ptr()) < 0) {  // as of an array without dimensions
    PyErr_Clear();
    return false;
  }
  for (const py::handle each : given) {
    if (is_bool(each) || has_bool(each, levels - 1)) return true;
  }
  return false;
}

void read_argument(py::handle given, const std::string& name, bool& flag) {
  if (!is_bool(given)) throw wrong_type(name, "True or False is expected", given);
  flag = py::bool_(py::reinterpret_borrow<py::object>(given));
}

void read_argument(py::handle given, const std::string& name, double& number) {
  if (is_bool(given)) throw wrong_type(name, "a number is expected", given);
  number = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr) return;
  const bool is_too_large = PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
  PyErr_Clear();
  if (is_too_large) refuse_size(given, name, "a number that a float can hold");
  throw wrong_type(name, "a number is expected", given);
}

void read_argument(py::handle given, const std::string& name, std::string& text) { text = to_string(given, name); }

void read_argument(py::handle given, const std::string& name, std::vector<std::string>& texts) {
  if (PyUnicode_Check(given.ptr()) != 0 || PyBytes_Check(given.ptr()) != 0) {
    texts = {to_string(given, name)};
    return;
  }
  if (PySequence_Check(given.ptr()) == 0) throw wrong_type(name, "a list is expected", given);
  texts.clear();
  for (const py::handle each : given) texts.push_back(to_string(each, name));
}

py::int_ to_whole_number(py::handle given, const std::string& name) {
  PyObject* whole = is_bool(given) ? nullptr : PyNumber_Index(given.ptr());
  if (whole != nullptr) return py::reinterpret_steal<py::int_>(whole);
  PyErr_Clear();
  throw wrong_type(name, "a whole number is expected", given);
}

void refuse_size(py::handle given, const std::string& name, const std::string& allowed) {
  throw InputError({"argument '" + name + "' is out of range", "", 0, name, show(given), allowed, ""});
}

Keywords::Keywords(py::handle given, const std::string& of) : of_(of) {
  if (!py::isinstance<py::dict>(given)) throw wrong_type(of, "a dict is expected", given);
  given_ = py::reinterpret_borrow<py::dict>(given);
}

void Keywords::require_all_read() const {
  for (const auto& [key, value] : given_) {
    const std::string name = to_string(key, of_.empty() ? "keyword" : of_);
    if (known_.count(name) > 0) continue;
    if (of_.empty()) throw py::type_error("unexpected keyword argument '" + name + "'");
    throw py::type_error("argument '" + of_ + "': unexpected key '" + name + "'");
  }
}

}  // namespace rollrig::python
