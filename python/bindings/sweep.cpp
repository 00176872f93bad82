#include <rollrig/sweep.h>

#include "arrays.h"
#include "bindings.h"
#include "call.h"
#include "run_input.h"
#include "sweep_axes.h"
#include "text.h"

namespace rollrig::python {
namespace {

std::shared_ptr<SweepResult> carry_out_sweep(const py::object& show, const py::dict& run, const py::dict& axes,
                                             const py::dict& options) {
  SweepInput input;
  input.run = read_run_input(run);
  input.axes = read_axes(axes);
  Keywords keywords(options);
  keywords.read("shown_results", input.shown).read("threads", input.threads).require_all_read();
  return std::make_shared<SweepResult>(
      call(show, [&](const Progress& progress) { return Sweep(input).carry_out(progress); }));
}

/// By name of the result a number for each point; NaN where a point has none.
py::dict list_columns(const SweepResult& sweep) {
  py::dict columns;
  for (std::size_t k = 0; k < sweep.results.size(); ++k) {
    std::vector<double> column;
    for (const std::vector<double>& row : sweep.values) column.push_back(row[k]);
    columns[to_str(sweep.results[k])] = to_array(std::move(column));
  }
  return columns;
}

py::list list_points(const SweepResult& sweep) {
  py::list points;
  for (const std::vector<std::string>& point : sweep.points) points.append(to_list(point));
  return points;
}

}  // namespace

void bind_sweep(py::module_& module) {
  py::class_<SweepResult, Report, std::shared_ptr<SweepResult>>(module, "SweepResult")
      .def_property_readonly("axes", [](const SweepResult& sweep) { return to_list(sweep.axes); })
      .def_property_readonly("points", &list_points)
      .def_property_readonly("columns", &list_columns)
      .def_property_readonly("failures", [](const SweepResult& sweep) { return to_list(sweep.failures); });
  module.def("sweep", &carry_out_sweep);
}

}  // namespace rollrig::python
