#include <rollrig/scaffold.h>

#include "arrays.h"
#include "bad_rows.h"
#include "bindings.h"
#include "call.h"
#include "keywords.h"
#include "text.h"

namespace rollrig::python {
namespace {

GuessOptions read_guess(const py::dict& given) {
  GuessOptions options;
  Keywords keywords(given);
  keywords.read("folder", options.folder).read("tire", options.tire).read("rig", options.rig);
  keywords.read("vehicle", options.vehicle).read("sensors", options.sensors).read("name", options.name);
  keywords.read("columns", options.columns).read("units", options.units).read("values", options.values);
  keywords.read("date_order", options.date_order).read("cold_pressure_kPa", options.cold_pressure_kPa);
  keywords.read("rests_min", options.rests_min).require_all_read();
  return options;
}

std::shared_ptr<Report> new_tire(const py::object& show, const py::dict& given, const py::dict& log) {
  NewTireOptions options;
  Keywords keywords(given);
  keywords.read("name", options.name).read("size", options.size).read("load_index", options.load_index);
  keywords.read("tire_class", options.tire_class).read("is_reinforced", options.is_reinforced);
  keywords.read("rrc_N_per_kN", options.rrc_N_per_kN).read("tir", options.tir);
  keywords.read("rrc_sd_N_per_kN", options.rrc_sd_N_per_kN).read("pressure_kPa", options.pressure_kPa);
  keywords.read("speed_symbol", options.speed_symbol).require_all_read();
  const GuessOptions guess = read_guess(log);
  return std::make_shared<NewFiles>(call(show, [&](const Progress& progress) {
    if (guess.folder.empty()) return make_new_tire(options);
    TireFitOptions how;
    how.progress = progress;
    return make_new_tire(options, guess, how);
  }));
}

std::shared_ptr<Report> new_rig(const py::dict& given) {
  NewRigOptions options;
  Keywords keywords(given);
  keywords.read("name", options.name).read("kind", options.kind).read("diameter_m", options.diameter_m);
  keywords.read("inertia_kg_m2", options.inertia_kg_m2).read("moving_mass_kg", options.moving_mass_kg);
  keywords.read("skim_load_N", options.skim_load_N).read("ambient_degC", options.ambient_degC);
  keywords.read("bearing_loss_N", options.bearing_loss_N).require_all_read();
  return std::make_shared<NewFiles>(call(py::none(), [&](const Progress&) { return make_new_rig(options); }));
}

std::shared_ptr<Report> new_vehicle(const py::dict& given) {
  NewVehicleOptions options;
  Keywords keywords(given);
  keywords.read("name", options.name).read("mass_kg", options.mass_kg).read("drag_area_m2", options.drag_area_m2);
  keywords.read("rotating_mass_kg", options.rotating_mass_kg).read("wheelbase_m", options.wheelbase_m);
  keywords.read("front_load_share", options.front_load_share).read("road_load", options.road_load);
  keywords.read("driven_axle", options.driven_axle).require_all_read();
  return std::make_shared<NewFiles>(call(py::none(), [&](const Progress&) { return make_new_vehicle(options); }));
}

std::shared_ptr<Report> import_folder(const py::dict& given, const std::string& folder, bool skip_bad_rows) {
  const GuessOptions options = read_guess(given);
  return std::make_shared<NewFiles>(
      call(py::none(), [&](const Progress&) { return import_guessed(options, folder, to_bad_rows(skip_bad_rows)); }));
}

std::shared_ptr<Report> guess_folder(const py::dict& given, const std::string& folder) {
  const GuessOptions options = read_guess(given);
  return std::make_shared<NewFiles>(call(py::none(), [&](const Progress&) { return guess_set(options, folder); }));
}

}  // namespace

void bind_new(py::module_& module) {
  module.def("make_new_tire", &new_tire);
  module.def("make_new_rig", &new_rig);
  module.def("make_new_vehicle", &new_vehicle);
  module.def("guess_set", &guess_folder);
  module.def("import_guessed", &import_folder);
}

}  // namespace rollrig::python
