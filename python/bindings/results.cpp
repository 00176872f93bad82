/// What is made of results and files: comparison, label, conversion, alignment, exports, regression.
#include <rollrig/align.h>
#include <rollrig/compare.h>
#include <rollrig/convert.h>
#include <rollrig/export.h>
#include <rollrig/fmu.h>
#include <rollrig/label.h>
#include <rollrig/regress.h>
#include <rollrig/vecto.h>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "keywords.h"
#include "run_input.h"
#include "text.h"

namespace rollrig::python {
namespace {

std::shared_ptr<Report> compare_all(const py::object& show, const std::vector<std::string>& compared,
                                    const py::object& scenario, const py::object& threads, bool skip_bad_rows) {
  const CompareInput input{compared, scenario.is_none() ? "" : to_string(scenario, "scenario"),
                           to_bad_rows(skip_bad_rows), read_argument<int>(threads, "threads")};
  return std::make_shared<Comparison>(call(show, [&](const Progress& progress) { return compare(input, progress); }));
}

std::shared_ptr<Report> make_tire_label(const py::dict& given) {
  LabelInput input;
  Keywords keywords(given);
  keywords.read("rrc_N_per_kN", input.rrc_N_per_kN).read("rrc_sd_N_per_kN", input.rrc_sd_N_per_kN);
  keywords.read("tire_class", input.tire_class).read("load_index", input.load_index);
  keywords.read("speed_symbol", input.speed_symbol).read("is_severe_snow", input.is_severe_snow);
  keywords.read("tire", input.tire).require_all_read();
  return std::make_shared<TireLabel>(call(py::none(), [&](const Progress&) { return make_label(input); }));
}

LossConditions read_conditions(const py::object& given, const std::string& argument) {
  LossConditions conditions;
  Keywords keywords(given, argument);
  keywords.read("drum_curvature_per_m", conditions.drum_curvature_per_m);
  keywords.read("tire_diameter_m", conditions.tire_diameter_m).read("pressure_Pa", conditions.pressure_Pa);
  keywords.read("ambient_K", conditions.ambient_K).read("load_N", conditions.load_N).require_all_read();
  return conditions;
}

std::shared_ptr<Report> convert(const py::dict& given, const py::object& measured, const py::object& wanted) {
  ConversionInput input;
  input.from = read_conditions(measured, "measured");
  input.to = read_conditions(wanted, "wanted");
  Keywords keywords(given);
  keywords.read("force_N", input.loss.force_N).read("rrc_N_per_kN", input.loss.rrc_N_per_kN).read("tire", input.tire);
  keywords.read("pressure_exponent", input.pressure_exponent).read("load_exponent", input.load_exponent);
  keywords.read("diameter_exponent", input.diameter_exponent);
  keywords.read("ambient_coefficient_per_K", input.ambient_coefficient_per_K).require_all_read();
  return std::make_shared<ConvertedLoss>(convert_loss(input));
}

std::shared_ptr<Report> align_machine(const py::object& show, const py::dict& uncertainty, const py::dict& given) {
  AlignmentInput input;
  Keywords keywords(given);
  keywords.read("file", input.file).read("reference_values", input.reference_values).read("machine", input.machine);
  keywords.read("reference_machine", input.reference_machine).read("reference", input.reference);
  keywords.read("preliminary", input.preliminary).read("first_excluded", input.first_excluded).read("on", input.on);
  keywords.read("machine_changed", input.machine_changed).require_all_read();
  const UncertaintyOptions asked = read_uncertainty(uncertainty);
  return std::make_shared<Alignment>(
      call(show, [&](const Progress& progress) { return align(input, asked, progress); }));
}

std::shared_ptr<Report> align_value(const py::object& show, const py::dict& uncertainty, const py::dict& given) {
  AlignedValueInput input;
  Keywords keywords(given);
  keywords.read("alignment", input.alignment).read("rrc_N_per_kN", input.rrc_N_per_kN);
  keywords.read("measurements", input.measurements).read("on", input.on).read("tire_class", input.tire_class);
  keywords.require_all_read();
  const UncertaintyOptions asked = read_uncertainty(uncertainty);
  return std::make_shared<AlignedValue>(
      call(show, [&](const Progress& progress) { return apply_alignment(input, asked, progress); }));
}

py::bytes export_bytes(const std::string& source, bool is_mat, bool skip_bad_rows) {
  const std::string made = call(py::none(), [&](const Progress&) {
    const Export exported = read_export(source, to_bad_rows(skip_bad_rows));
    return is_mat ? exported.make_mat() : exported.make_hdf5();
  });
  return py::bytes(made);
}

py::bytes make_fmu_bytes(const py::dict& given) {
  FmuInput input;
  Keywords keywords(given);
  keywords.read("tire", input.tire).read("rig", input.rig).read("effects", input.effects);
  keywords.read("fmi_version", input.fmi_version).require_all_read();
  return py::bytes(call(py::none(), [&](const Progress&) { return make_fmu(input); }));
}

py::str make_vecto(const py::dict& given) {
  VectoTireInput input;
  Keywords keywords(given);
  keywords.read("tire", input.tire).read("rrc_N_per_kN", input.rrc_N_per_kN).read("model", input.model);
  keywords.read("manufacturer", input.manufacturer).read("certification_number", input.certification_number);
  keywords.read("date", input.date).read("dimension", input.dimension).require_all_read();
  return to_str(call(py::none(), [&](const Progress&) { return make_vecto_tire(input).xml; }));
}

std::shared_ptr<Report> regress_folder(const py::object& show, const std::string& folder, const py::object& threads) {
  const int count = read_argument<int>(threads, "threads");
  return std::make_shared<Regression>(call(show, [&](const Progress& progress) {
    return regress(folder, {count, progress});
  }));
}

}  // namespace

void bind_results(py::module_& module) {
  module.def("compare", &compare_all);
  module.def("make_label", &make_tire_label);
  module.def("convert_loss", &convert);
  module.def("align", &align_machine);
  module.def("apply_alignment", &align_value);
  module.def("export_bytes", &export_bytes);
  module.def("make_fmu", &make_fmu_bytes);
  module.def("make_vecto_tire", &make_vecto);
  module.def("regress", &regress_folder);
}

}  // namespace rollrig::python
