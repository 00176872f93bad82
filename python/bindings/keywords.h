#pragma once
/// Keyword arguments, which become members of the API's structs under the same names.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <set>
#include <string>

#include "bindings.h"

namespace rollrig::python {

/// Reads a dict whose absent keys leave a member as it is.
class Keywords {
 public:
  explicit Keywords(py::dict given) : given_(std::move(given)) {}

  template <class Member>
  Keywords& read(const char* name, Member& member) {
    known_.insert(name);
    if (given_.contains(name)) member = given_[name].cast<Member>();
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
