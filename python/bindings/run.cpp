#include <rollrig/run.h>

#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "call.h"
#include "files.h"
#include "run_input.h"
#include "text.h"

namespace rollrig::python {
namespace {

Run make_run(const py::dict& given) {
  const RunInput input = read_run_input(given);
  std::optional<Run> run;
  do_without_gil([&] { run.emplace(input); });
  return *run;
}

std::shared_ptr<RunResult> carry_out_run(const Run& run, const py::object& show, const py::dict& uncertainty) {
  const UncertaintyOptions options = read_uncertainty(uncertainty);
  return std::make_shared<RunResult>(
      call(show, [&](const Progress& progress) { return run.carry_out(progress, options); }));
}

/// Name, label, unit, meaning and value of each: a number, words, or None.
py::list list_values(const std::vector<ResultValue>& values) {
  py::list list;
  for (const ResultValue& at : values) {
    py::object value = py::none();
    if (at.number.has_value()) value = py::float_(*at.number);
    if (!at.text.empty()) value = to_str(at.text);
    list.append(py::make_tuple(to_str(at.name), to_str(at.label), to_str(at.unit), to_str(at.doc), value));
  }
  return list;
}

/// By name the meaning and the records.
py::dict list_records(const std::vector<ResultRecords>& lists) {
  py::dict dict;
  for (const ResultRecords& at : lists) {
    py::list records;
    for (const std::vector<ResultValue>& record : at.records) records.append(list_values(record));
    dict[to_str(at.name)] = py::make_tuple(to_str(at.doc), records);
  }
  return dict;
}

/// Times, phase of each row as an index, phases, channels.
py::tuple make_recording(const RunResult& result) {
  Recording recording;
  do_without_gil([&] { recording = result.make_recording(); });
  py::list phases;
  for (const Phase& phase : recording.phases) {
    phases.append(py::make_tuple(to_str(phase.name), phase.start_s, phase.end_s));
  }
  return py::make_tuple(to_array(std::move(recording.time_s)), to_array(std::move(recording.phase)), phases,
                        to_list(std::move(recording.channels)));
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<RunResult, Report, std::shared_ptr<RunResult>>(module, "RunResult")
      .def_property_readonly("values", [](const RunResult& result) { return list_values(result.values); })
      .def_property_readonly("records", [](const RunResult& result) { return list_records(result.records); })
      .def_property_readonly("warnings", [](const RunResult& result) { return to_list(result.warnings); })
      .def_readonly("mechanical_closure", &RunResult::mechanical_closure)
      .def_readonly("thermal_closure", &RunResult::thermal_closure)
      .def("make_recording", &make_recording)
      .def("make_set_files", [](const RunResult& result) {
        return result.make_set_files ? py::object(make_files(result.make_set_files)) : py::none();
      });
  py::class_<Run>(module, "Run")
      .def(py::init(&make_run))
      .def_property_readonly("scenario", &Run::scenario)
      .def_property_readonly("writes_set", &Run::writes_set)
      .def_property_readonly("has_sensors", &Run::has_sensors)
      .def_property_readonly("has_uncertainty", &Run::has_uncertainty)
      .def("carry_out", &carry_out_run);
}

}  // namespace rollrig::python
