#include <rollrig/result.h>

#include "arrays.h"
#include "bindings.h"
#include "text.h"

namespace rollrig::python {
namespace {

/// Of a function that a report may lack.
py::object make_text(const std::function<std::string()>& make) {
  if (!make) return py::none();
  std::string text;
  {
    const py::gil_scoped_release released;
    text = make();
  }
  return to_str(text);
}

py::dict to_dict(const FolderFiles& files) {
  py::dict dict;
  for (const auto& [name, content] : files) dict[to_str(name)] = to_str(content);
  return dict;
}

py::dict make_files(const std::function<FolderFiles()>& make) {
  FolderFiles files;
  if (make) {
    const py::gil_scoped_release released;
    files = make();
  }
  return to_dict(files);
}

}  // namespace

void bind_report(py::module_& module) {
  py::class_<Report, std::shared_ptr<Report>>(module, "Report")
      .def_property_readonly("text", [](const Report& report) { return to_str(report.text); })
      .def_property_readonly("json", [](const Report& report) { return to_str(report.json); })
      .def("make_files", [](const Report& report) { return make_files(report.make_files); })
      .def("make_page", [](const Report& report) { return make_text(report.make_page); })
      .def("make_test_report", [](const Report& report) { return make_text(report.make_test_report); })
      .def("write", [](const Report& report, const std::string& folder, bool force) {
        const py::gil_scoped_release released;
        write_folder(folder, report.make_files ? report.make_files() : FolderFiles(), force);
      });
}

}  // namespace rollrig::python
