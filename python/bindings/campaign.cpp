#include <rollrig/item_campaign.h>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "run_input.h"
#include "sweep_axes.h"
#include "text.h"

namespace rollrig::python {
namespace {

void define_runs(const std::string& folder, const py::dict& run, const py::dict& axes, const py::dict& options) {
  RunCampaignInput input;
  input.run = read_run_input(run);
  input.axes = read_axes(axes);
  Keywords keywords(options);
  keywords.read("drawn", input.drawn).read("drawn_sd", input.drawn_sd).read("list", input.list);
  keywords.read("design", input.design).read("points", input.points).require_all_read();
  do_without_gil([&] { define_run_campaign(input, folder); });
}

py::list define_diagnoses(const std::string& folder, const py::dict& options) {
  DiagnosisCampaignInput input;
  bool skip_bad_rows = false;
  Keywords keywords(options);
  keywords.read("sets", input.sets).read("only", input.only).read("without", input.without);
  keywords.read("smallest_effect_percent", input.smallest_effect_percent).read("skip_bad_rows", skip_bad_rows);
  keywords.require_all_read();
  input.bad_rows = to_bad_rows(skip_bad_rows);
  return to_list(call(py::none(), [&](const Progress&) { return define_diagnosis_campaign(input, folder); }));
}

std::shared_ptr<CampaignState> carry_out_part(const ItemCampaign& campaign, const py::object& show,
                                              const py::object& part, const py::object& threads) {
  const CampaignPart wanted = part.is_none() ? CampaignPart{} : read_campaign_part(to_string(part, "part"));
  const int count = read_argument<int>(threads, "threads");
  return std::make_shared<CampaignState>(
      call(show, [&](const Progress& progress) { return campaign.carry_out(wanted, count, progress); }));
}

py::str write_csv(const ItemCampaign& campaign) {
  std::string table;
  do_without_gil([&] { campaign.write_csv([&table](const std::string& rows) { table += rows; }); });
  return to_str(table);
}

}  // namespace

void bind_campaign(py::module_& module) {
  py::class_<CampaignState, Report, std::shared_ptr<CampaignState>>(module, "CampaignState")
      .def_readonly("items", &CampaignState::items)
      .def_readonly("done", &CampaignState::done)
      .def_readonly("failed", &CampaignState::failed);
  py::class_<ItemCampaign>(module, "ItemCampaign")
      .def(py::init<const std::string&>())
      .def("carry_out", &carry_out_part)
      .def("read_state",
           [](const ItemCampaign& at) {
             return std::make_shared<CampaignState>(call(py::none(), [&](const Progress&) { return at.read_state(); }));
           })
      .def("merge",
           [](const ItemCampaign& at) {
             return std::make_shared<CampaignState>(call(py::none(), [&](const Progress&) { return at.merge(); }));
           })
      .def("write_csv", &write_csv)
      .def("calc_sensitivity",
           [](const ItemCampaign& at, const py::object& result) {
             const std::string name = to_string(result, "result");
             return std::make_shared<Report>(
                 call(py::none(), [&](const Progress&) { return at.calc_sensitivity(name); }));
           })
      .def("summarize_diagnoses", [](const ItemCampaign& at) {
        return std::make_shared<Report>(call(py::none(), [&](const Progress&) { return at.summarize_diagnoses(); }));
      });
  module.def("define_run_campaign", &define_runs);
  module.def("define_diagnosis_campaign", &define_diagnoses);
}

}  // namespace rollrig::python
