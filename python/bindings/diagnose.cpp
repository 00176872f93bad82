#include <rollrig/diagnose.h>
#include <rollrig/loop.h>
#include <rollrig/machine_pair.h>
#include <rollrig/plan.h>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "files.h"
#include "keywords.h"
#include "text.h"

namespace rollrig::python {
namespace {

DiagnosisOptions read_options(Keywords& given) {
  DiagnosisOptions options;
  given.read("without", options.without).read("only", options.only).read("threads", options.threads);
  given.read("smallest_effect_percent", options.smallest_effect_percent);
  return options;
}

DiagnosisOptions read_options(const py::dict& given) {
  Keywords keywords(given);
  DiagnosisOptions options = read_options(keywords);
  keywords.require_all_read();
  return options;
}

std::shared_ptr<Diagnosis> diagnose_set(const py::object& show, const MeasurementSet& set, const py::dict& given) {
  DiagnosisOptions options = read_options(given);
  return std::make_shared<Diagnosis>(call(show, [&](const Progress& progress) {
    options.progress = progress;
    return diagnose(set, options);
  }));
}

std::shared_ptr<Report> diagnose_sets(const py::object& show, const std::vector<std::string>& folders,
                                      bool skip_bad_rows, const py::dict& given) {
  DiagnosisOptions options = read_options(given);
  return std::make_shared<FleetDiagnosis>(call(show, [&](const Progress& progress) {
    options.progress = progress;
    return diagnose_fleet(folders, options, to_bad_rows(skip_bad_rows));
  }));
}

std::shared_ptr<Report> diagnose_machines(const py::object& show, const MeasurementSet& a, const MeasurementSet& b,
                                          const py::dict& given) {
  DiagnosisOptions options = read_options(given);
  return std::make_shared<PairDiagnosis>(call(show, [&](const Progress& progress) {
    options.progress = progress;
    return diagnose_pair(a, b, options);
  }));
}

/// The report, and the files that are waited for.
py::tuple advance(const py::object& show, const py::dict& given) {
  LoopInput input;
  bool skip_bad_rows = false;
  Keywords keywords(given);
  keywords.read("set", input.set).read("folder", input.folder).read("hours", input.hours);
  keywords.read("test_failed", input.test_failed).read("skip_bad_rows", skip_bad_rows);
  input.diagnosis = read_options(keywords);
  keywords.require_all_read();
  input.bad_rows = to_bad_rows(skip_bad_rows);
  const auto loop = std::make_shared<Loop>(call(show, [&](const Progress& progress) {
    input.diagnosis.progress = progress;
    return advance_loop(input);
  }));
  return py::make_tuple(std::shared_ptr<Report>(loop), to_list(loop->missing));
}

std::shared_ptr<Report> plan(const py::object& show, const py::dict& given) {
  CampaignInput input;
  Keywords keywords(given);
  keywords.read("rig", input.rig).read("tire", input.tire).read("vehicle", input.vehicle);
  keywords.read("sensors", input.sensors).read("hours", input.hours).read("only", input.only);
  keywords.read("without", input.without).read("threads", input.threads).require_all_read();
  return std::make_shared<Campaign>(call(show, [&](const Progress& progress) {
    input.progress = progress;
    return plan_campaign(input);
  }));
}

}  // namespace

void bind_diagnose(py::module_& module) {
  // Its report is not its first base, which pybind11 has to be told.
  py::class_<Diagnosis, Report, std::shared_ptr<Diagnosis>>(module, "Diagnosis", py::multiple_inheritance())
      .def("make_plan", [](const Diagnosis& found) { return make_files(found.make_plan); });
  module.def("diagnose", &diagnose_set);
  module.def("diagnose_fleet", &diagnose_sets);
  module.def("diagnose_pair", &diagnose_machines);
  module.def("advance_loop", &advance);
  module.def("plan_campaign", &plan);
  module.def("explain_effect",
             [](const py::object& effect) { return to_str(explain_effect(to_string(effect, "effect"))); });
}

}  // namespace rollrig::python
