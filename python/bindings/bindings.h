#pragma once
/// The extension module rollrig._rollrig: what the C++ API has and Python cannot do by itself. What a user calls is in
/// python/rollrig, which gives it keyword arguments and doc strings.

#include <pybind11/pybind11.h>

namespace rollrig::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_report(py::module_& module);
void bind_run(py::module_& module);
void bind_sweep(py::module_& module);
void bind_campaign(py::module_& module);
void bind_sets(py::module_& module);
void bind_diagnose(py::module_& module);
void bind_fits(py::module_& module);
void bind_new(py::module_& module);
void bind_assets(py::module_& module);
void bind_results(py::module_& module);

}  // namespace rollrig::python
