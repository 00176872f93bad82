#pragma once
/// Numbers of the library as NumPy arrays, which take them over without a copy.

#include <pybind11/numpy.h>
#include <rollrig/result.h>

#include <memory>
#include <utility>
#include <vector>

#include "bindings.h"
#include "text.h"

namespace rollrig::python {

template <class Number>
py::array_t<Number> to_array(std::vector<Number> numbers) {
  auto owner = std::make_unique<std::vector<Number>>(std::move(numbers));
  const std::vector<Number>& kept = *owner;
  const py::capsule base(owner.release(), [](void* held) { delete static_cast<std::vector<Number>*>(held); });
  return py::array_t<Number>(static_cast<py::ssize_t>(kept.size()), kept.data(), base);
}

/// Name, unit and values of each.
inline py::list to_list(std::vector<Channel> channels) {
  py::list list;
  for (Channel& channel : channels) {
    list.append(py::make_tuple(to_str(channel.name), to_str(channel.unit), to_array(std::move(channel.values))));
  }
  return list;
}

/// Name, value, sd, low_95, high_95 and unit of each.
inline py::list to_list(const std::vector<ParameterEstimate>& estimates) {
  py::list list;
  for (const ParameterEstimate& at : estimates) {
    list.append(py::make_tuple(to_str(at.name), at.value, at.sd, at.low_95, at.high_95, to_str(at.unit)));
  }
  return list;
}

inline py::list to_list(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(to_str(text));
  return list;
}

}  // namespace rollrig::python
