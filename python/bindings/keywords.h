#pragma once
/// Keyword arguments, which become members of the API's structs under the same names.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.h"
#include "text.h"

namespace rollrig::python {

/// What a type is in messages.
template <class Member>
struct Expected {
  static constexpr const char* kName = std::is_same_v<Member, bool>       ? "True or False"
                                       : std::is_integral_v<Member>       ? "a whole number"
                                       : std::is_floating_point_v<Member> ? "a number"
                                                                          : "another value";
};
template <>
struct Expected<std::string> {
  static constexpr const char* kName = "a text";
};
template <class Inner>
struct Expected<std::optional<Inner>> : Expected<Inner> {};
template <std::size_t kSize>
struct Expected<std::array<double, kSize>> {
  static constexpr const char* kName = kSize == 3 ? "three numbers" : "numbers";
};
template <>
struct Expected<std::pair<double, double>> {
  static constexpr const char* kName = "two numbers";
};
template <>
struct Expected<std::pair<std::array<double, 3>, std::array<double, 3>>> {
  static constexpr const char* kName = "two times three numbers";
};

/// Each throws TypeError, which names the argument.
template <class Member>
void read_argument(py::handle given, const std::string& name, Member& member) {
  try {
    member = given.cast<Member>();
  } catch (const py::cast_error&) {
    throw py::type_error("argument '" + name + "': " + Expected<Member>::kName + " is expected, not " +
                         py::repr(given).cast<std::string>());
  }
}
inline void read_argument(py::handle given, const std::string& name, std::string& text) {
  text = to_string(given, name);
}
inline void read_argument(py::handle given, const std::string& name, std::optional<std::string>& text) {
  text = to_string(given, name);
}
/// A text alone is a list of it.
inline void read_argument(py::handle given, const std::string& name, std::vector<std::string>& texts) {
  if (PyUnicode_Check(given.ptr()) != 0 || PyBytes_Check(given.ptr()) != 0) {
    texts = {to_string(given, name)};
    return;
  }
  if (PySequence_Check(given.ptr()) == 0) {
    throw py::type_error("argument '" + name + "': a list is expected, not " + py::repr(given).cast<std::string>());
  }
  texts.clear();
  for (const py::handle each : given) texts.push_back(to_string(each, name));
}
template <class Value>
void read_argument(py::handle given, const std::string& name, std::map<std::string, Value>& values) {
  if (!py::isinstance<py::dict>(given)) {
    throw py::type_error("argument '" + name + "': a dict is expected, not " + py::repr(given).cast<std::string>());
  }
  values.clear();
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(given)) {
    read_argument(value, name, values[to_string(key, name)]);
  }
}

/// Reads a dict whose absent keys leave a member as it is.
class Keywords {
 public:
  explicit Keywords(py::dict given) : given_(std::move(given)) {}

  template <class Member>
  Keywords& read(const char* name, Member& member) {
    known_.insert(name);
    if (given_.contains(name)) read_argument(given_[name], name, member);
    return *this;
  }
  /// Throws TypeError for a key that was not read.
  void require_all_read() const {
    for (const auto& [key, value] : given_) {
      const std::string name = key.cast<std::string>();
      if (known_.count(name) == 0) throw py::type_error("unexpected keyword argument '" + name + "'");
    }
  }

 private:
  py::dict given_;
  std::set<std::string> known_;
};

}  // namespace rollrig::python
