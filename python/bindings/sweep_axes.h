#pragma once
/// Settings that take several values.

#include <pybind11/stl.h>
#include <rollrig/sweep.h>

#include <string>
#include <vector>

#include "bindings.h"
#include "keywords.h"

namespace rollrig::python {

/// By key a list of values, or a text such as "210:310:20". Throws InputError.
inline std::vector<SweepAxis> read_axes(const py::dict& given) {
  std::vector<SweepAxis> axes;
  for (const auto& [name, values] : given) {
    const std::string key = to_string(name, "vary");
    if (py::isinstance<py::str>(values)) {
      axes.push_back(read_sweep_axis(key + "=" + to_string(values, "vary")));
    } else {
      axes.push_back({key, {}});
      read_argument(values, "vary", axes.back().values);
    }
  }
  return axes;
}

}  // namespace rollrig::python
