#include <rollrig/fit.h>
#include <rollrig/road_load.h>
#include <rollrig/rolling_law.h>

#include <map>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "keywords.h"
#include "run_input.h"
#include "text.h"

namespace rollrig::python {
namespace {

/// What all fits have.
struct Fit : Report {
  std::vector<ParameterEstimate> parameters;
  std::vector<std::string> warnings;
  std::string suspicion;
};

std::shared_ptr<Fit> to_fit(TireFit fit) {
  return std::make_shared<Fit>(Fit{fit, fit.parameters, fit.warnings, fit.suspicion});
}
std::shared_ptr<Fit> to_fit(RoadLoad fit) {
  return std::make_shared<Fit>(Fit{fit, fit.coefficients, fit.warnings, ""});
}
std::shared_ptr<Fit> to_fit(RollingLaw fit) {
  return std::make_shared<Fit>(Fit{fit, fit.coefficients, fit.warnings, ""});
}

std::shared_ptr<Fit> fit_to_set(const py::object& show, const MeasurementSet& set, const py::dict& given) {
  TireFitOptions options;
  Keywords keywords(given);
  keywords.read("name", options.name).read("load_map", options.load_map).read("free_H", options.free_H);
  keywords.read("threads", options.threads).require_all_read();
  return to_fit(call(show, [&](const Progress& progress) {
    options.progress = progress;
    return fit_tire(set, options);
  }));
}

using Abc = std::array<double, 3>;

RoadLoadFitOptions read_fit_options(const py::dict& given) {
  RoadLoadFitOptions options;
  std::optional<std::pair<Abc, Abc>> bounds;
  Keywords keywords(given);
  keywords.read("mass_kg", options.mass_kg).read("rotating_mass_kg", options.rotating_mass_kg);
  keywords.read("drag_area_m2", options.drag_area_m2).read("bounds", bounds).read("target", options.target);
  keywords.read("reference_temperature_K", options.reference_temperature_K);
  keywords.read("reference_pressure_Pa", options.reference_pressure_Pa);
  keywords.read("rolling_fall_per_K", options.rolling_fall_per_K).read("speed_from_m_s", options.speed_from_m_s);
  keywords.read("speed_to_m_s", options.speed_to_m_s).read("bin_width_m_s", options.bin_width_m_s);
  keywords.read("leave_out", options.leave_out).read("recorded_vehicle", options.recorded_vehicle).require_all_read();
  if (bounds.has_value()) options.bounds = RoadLoadBounds{bounds->first, bounds->second};
  return options;
}

RoadLoadProcedureKind to_kind(const std::string& name) {
  static const std::map<std::string, RoadLoadProcedureKind> kinds{
      {"wltp", RoadLoadProcedureKind::kWltp},
      {"j2263", RoadLoadProcedureKind::kJ2263},
      {"j1263", RoadLoadProcedureKind::kJ1263},
      {"torque-meter", RoadLoadProcedureKind::kTorqueMeter}};
  const auto found = kinds.find(name);
  if (found != kinds.end()) return found->second;
  throw InputError({"unknown procedure '" + name + "'", "", 0, "method", name, "wltp, j2263, j1263, torque-meter", ""});
}

RoadLoadProcedureOptions read_procedure(const std::string& method, const py::dict& given) {
  RoadLoadProcedureOptions options;
  options.kind = to_kind(method);
  Keywords keywords(given);
  keywords.read("mass_kg", options.mass_kg).read("rotating_mass_kg", options.rotating_mass_kg);
  keywords.read("corrected_to_mass_kg", options.corrected_to_mass_kg);
  keywords.read("reference_temperature_K", options.reference_temperature_K);
  keywords.read("reference_pressure_Pa", options.reference_pressure_Pa);
  keywords.read("rolling_fall_per_K", options.rolling_fall_per_K).read("speed_from_m_s", options.speed_from_m_s);
  keywords.read("speed_to_m_s", options.speed_to_m_s).read("yaw_degree", options.yaw_degree);
  keywords.read("wheel_radius_m", options.wheel_radius_m).read("sensor_accuracy", options.sensor_accuracy);
  keywords.read("leave_out", options.leave_out).require_all_read();
  return options;
}

/// Without a method by least squares, else by the procedure of that name.
std::shared_ptr<Fit> fit_coastdowns(const py::object& show, const std::string& file, const py::object& given_method,
                                    const py::object& given_sessions, bool skip_bad_rows, const py::dict& uncertainty,
                                    const py::dict& given) {
  const auto sessions = read_argument<std::vector<std::string>>(given_sessions, "sessions");
  const UncertaintyOptions asked = read_uncertainty(uncertainty);
  const BadRows bad_rows = to_bad_rows(skip_bad_rows);
  if (given_method.is_none()) {
    const RoadLoadFitOptions options = read_fit_options(given);
    return to_fit(call(show, [&](const Progress& progress) {
      return fit_road_load(file, options, sessions, bad_rows, asked, progress);
    }));
  }
  const RoadLoadProcedureOptions options = read_procedure(to_string(given_method, "method"), given);
  return to_fit(call(show, [&](const Progress& progress) {
    return evaluate_road_load(file, options, sessions, bad_rows, asked, progress);
  }));
}

std::shared_ptr<Fit> calc_default_road_load_fit(const py::dict& given) {
  DefaultRoadLoadOptions options;
  Keywords keywords(given);
  keywords.read("mass_kg", options.mass_kg).read("width_m", options.width_m).read("height_m", options.height_m);
  keywords.read("tire_class", options.tire_class).read("rrc_N_per_kN", options.rrc_N_per_kN).require_all_read();
  return to_fit(calc_default_road_load(options));
}

/// J2452, or J1269 in either form.
std::shared_ptr<Fit> fit_law(const py::object& show, const std::string& law, const std::string& path,
                             const py::dict& uncertainty, const py::dict& given) {
  const UncertaintyOptions asked = read_uncertainty(uncertainty);
  RollingLawOptions options;
  Keywords keywords(given);
  keywords.read("maximum_load_N", options.maximum_load_N).read("base_pressure_Pa", options.base_pressure_Pa);
  keywords.read("warm_pressure", options.warm_pressure).read("urban_cycle", options.urban_cycle);
  keywords.read("highway_cycle", options.highway_cycle).require_all_read();
  return to_fit(call(show, [&](const Progress& progress) {
    if (law == "j2452") return fit_j2452(path, options, asked, progress);
    return fit_j1269(path, options, law == "j1269_proportional", asked, progress);
  }));
}

}  // namespace

void bind_fits(py::module_& module) {
  py::class_<Fit, Report, std::shared_ptr<Fit>>(module, "Fit")
      .def_property_readonly("parameters", [](const Fit& fit) { return to_list(fit.parameters); })
      .def_property_readonly("warnings", [](const Fit& fit) { return to_list(fit.warnings); })
      .def_property_readonly("suspicion", [](const Fit& fit) { return to_str(fit.suspicion); });
  module.def("fit_tire", &fit_to_set);
  module.def("fit_road_load", &fit_coastdowns);
  module.def("calc_default_road_load", &calc_default_road_load_fit);
  module.def("fit_law", &fit_law);
  module.def("fit_drum_coastdown", [](const py::object& show, const std::string& set, const std::string& data,
                                      bool skip_bad_rows, const py::dict& uncertainty) {
    const UncertaintyOptions asked = read_uncertainty(uncertainty);
    return std::make_shared<Report>(call(show, [&](const Progress& progress) {
      return fit_drum_coastdown(set, data, to_bad_rows(skip_bad_rows), asked, progress);
    }));
  });
}

}  // namespace rollrig::python
