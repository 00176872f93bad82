#include <rollrig/result.h>

#include "arrays.h"
#include "bindings.h"
#include "call.h"
#include "files.h"
#include "text.h"

namespace rollrig::python {
namespace {

/// Of a function that a report may lack.
py::object make_text(const std::function<std::string()>& make) {
  if (!make) return py::none();
  std::string text;
  do_without_gil([&] { text = make(); });
  return to_str(text);
}

/// The bytes of a text that to_str() has made.
std::string to_content(py::handle text) {
  PyObject* made = PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape");
  if (made == nullptr) throw py::error_already_set();
  return static_cast<std::string>(py::reinterpret_steal<py::bytes>(made));
}

py::dict to_dict(const FolderFiles& files) {
  py::dict dict;
  for (const auto& [name, content] : files) dict[to_str(name)] = to_str(content);
  return dict;
}

void write_files(const std::string& folder, const py::dict& given, bool force) {
  FolderFiles files;
  for (const auto& [name, content] : given) {
    files.emplace_back(to_string(name, "name"), to_content(content));
  }
  do_without_gil([&] { write_folder(folder, files, force); });
}

}  // namespace

py::dict make_files(const std::function<FolderFiles()>& make) {
  FolderFiles files;
  if (make) do_without_gil([&] { files = make(); });
  return to_dict(files);
}

void bind_report(py::module_& module) {
  module.def("write_folder", &write_files);
  py::class_<Report, std::shared_ptr<Report>>(module, "Report")
      .def_property_readonly("text", [](const Report& report) { return to_str(report.text); })
      .def_property_readonly("json", [](const Report& report) { return to_str(report.json); })
      .def("make_files", [](const Report& report) { return make_files(report.make_files); })
      .def("make_page", [](const Report& report) { return make_text(report.make_page); })
      .def("make_test_report", [](const Report& report) { return make_text(report.make_test_report); })
      .def("write", [](const Report& report, const std::string& folder, bool force) {
        do_without_gil([&] { write_folder(folder, report.make_files ? report.make_files() : FolderFiles(), force); });
      });
}

}  // namespace rollrig::python
