#include <rollrig/measurement_set.h>

#include <optional>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "text.h"

namespace rollrig::python {
namespace {

/// Id, session, temperature in K, cold pressure in Pa, rest before in s, times, columns of each.
py::list list_runs(const MeasurementSet& set) {
  py::list list;
  std::vector<MeasuredRun> runs = call(py::none(), [&](const Progress&) { return set.list_runs(); });
  for (MeasuredRun& run : runs) {
    list.append(py::make_tuple(to_str(run.id), to_str(run.session), run.initial_tire_temperature_K,
                               run.cold_pressure_Pa, run.rest_before_s, to_array(std::move(run.time_s)),
                               to_list(std::move(run.columns))));
  }
  return list;
}

py::tuple check(const std::string& path, bool skip_bad_rows) {
  const FileCheck checked =
      call(py::none(), [&](const Progress&) { return check_file(path, to_bad_rows(skip_bad_rows)); });
  return py::make_tuple(to_str(checked.what), to_list(checked.warnings), checked.is_good);
}

}  // namespace

void bind_sets(py::module_& module) {
  py::class_<MeasurementSet>(module, "MeasurementSet")
      .def(py::init([](const std::string& folder, bool skip_bad_rows) {
        return call(py::none(), [&](const Progress&) { return MeasurementSet(folder, to_bad_rows(skip_bad_rows)); });
      }))
      .def_property_readonly("name", [](const MeasurementSet& set) { return to_str(set.name()); })
      .def_property_readonly("kind", &MeasurementSet::kind)
      .def_property_readonly("tire", [](const MeasurementSet& set) { return to_str(set.tire()); })
      .def("list_runs", &list_runs);
  module.def("check_file", &check);
  module.def("import_logs", [](const std::string& mapping, const std::string& data, bool skip_bad_rows) {
    return std::make_shared<Report>(
        call(py::none(), [&](const Progress&) { return import_logs(mapping, data, to_bad_rows(skip_bad_rows)); }));
  });
  module.def("find_sets", [](const std::string& folder) { return to_list(find_sets(folder)); });
}

}  // namespace rollrig::python
