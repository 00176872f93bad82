#include "rollrig/scaffold.h"

#include <fmt/format.h>

#include <filesystem>

#include "api/data.h"
#include "measurements/logs/guess.h"
#include "measurements/logs/import.h"
#include "rollrig/fit.h"
#include "scenarios/scaffold/class_tire.h"
#include "scenarios/scaffold/iso_test.h"
#include "scenarios/scaffold/new_machine.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kMappingName = "import.toml";

std::string format_guesses(const measurements::Guess& guess) {
  std::string text = "  guessed from the logs; each guess may be wrong:\n";
  for (const measurements::GuessLine& line : measurements::list_guesses(guess)) {
    text +=
        wrap(fmt::format("{}: {}{}", line.subject, line.taken, line.reason.empty() ? "" : " (" + line.reason + ")"), 4);
  }
  return text;
}

Json make_guess_json(const measurements::Guess& guess) {
  Json json{{"format", "rollrig-guess/1"}, {"guesses", Json::array()}};
  for (const auto& [subject, taken, reason] : measurements::list_guesses(guess)) {
    json["guesses"].push_back({{"subject", subject}, {"taken", taken}, {"reason", reason}});
  }
  return json;
}

NewFiles make_files_report(std::string text, Json json, const FolderFiles& files) {
  NewFiles made;
  made.text = std::move(text);
  made.json = to_text(json);
  made.make_files = [files] { return files; };
  return made;
}

/// The mapping as import.toml in the working folder would say it.
measurements::Mapping read_guessed_mapping(const measurements::Guess& guess) {
  return measurements::read_mapping(parse_config(measurements::write_guessed_mapping(guess, "."), kMappingName),
                                    kMappingName);
}

/// The runs of a set as they are imported, in memory.
MeasurementSet make_set(const measurements::Mapping& mapping, const measurements::Import& imported) {
  measurements::MeasurementSet set = mapping.set;
  set.path = set.name;
  set.sensors = imported.sensors;
  for (const measurements::ImportedRun& run : imported.runs) {
    measurements::MeasuredRun measured;
    static_cast<measurements::RunTable&>(measured) = run.plan;
    measured.file = run.plan.torque_log;
    measured.time_s = run.rows.time_s;
    measured.columns = run.rows.columns;
    set.runs.push_back(std::move(measured));
  }
  return MeasurementSet(std::make_shared<const MeasurementSet::Data>(MeasurementSet::Data{std::move(set)}));
}

/// Puts the numbers of a fit into a new tire, with the notes of those that were fitted.
void put_fit(const TireFit& fit, scenarios::ClassTire& made) {
  const std::string toml = fit.make_files().front().second;  // the tire file
  made.tire = models::read_tire(parse_config(toml, made.tire.name));
  for (const auto& [key, comment] : scenarios::read_comments(toml)) made.notes[key] = comment;
}

/// The sentences about a new tire, `rrc_N_per_kN` being what its simulated test gives.
std::string format_new_tire(const scenarios::ClassTire& made, double rrc_N_per_kN) {
  const models::Iso28580Reference& iso = *made.tire.iso_28580;
  const Table table{"",
                    {},
                    {{"Class", fmt::format("{} ({})", made.tire_class, made.class_reason)},
                     {"Load of the index", fmt::format("{:.0f} N", made.load_capacity_N)},
                     {"Test of ISO 28580", fmt::format("{:.0f} N, {:.0f} kPa, 80 km/h, warm-up {:.0f} min", iso.load_N,
                                                       iso.pressure_Pa / 1e3, iso.warm_up_s / 60.0)},
                     {"RRc given", fmt::format("{:.3f} N/kN", 1e3 * iso.rrc)},
                     {"RRc simulated", fmt::format("{:.3f} N/kN", rrc_N_per_kN)},
                     {"Values of the class", fmt::format("of {}, in proportion to size and load", made.base)}}};
  return fmt::format("new tire   {}   {}\n", made.tire.name, made.tire.designation) + format_tables({table});
}

Json make_tire_json(const scenarios::ClassTire& made, double rrc_N_per_kN) {
  return {{"format", "rollrig-new-tire/1"},
          {"tire", made.tire.name},
          {"class", made.tire_class},
          {"base", made.base},
          {"load_N", made.tire.iso_28580->load_N},
          {"pressure_kPa", made.tire.iso_28580->pressure_Pa / 1e3},
          {"rrc_N_per_kN", 1e3 * made.tire.iso_28580->rrc},
          {"simulated_rrc_N_per_kN", rrc_N_per_kN}};
}

std::string name_of_file(const std::string& name) { return name + ".toml"; }

}  // namespace

NewFiles make_new_tire(const NewTireOptions& options) {
  const scenarios::ClassTire made = scenarios::make_class_tire(options);
  const double rrc_N_per_kN = 1e3 * scenarios::simulate_iso_rrc(made.tire);
  return make_files_report(format_new_tire(made, rrc_N_per_kN) + format_warnings(made.warnings),
                           make_tire_json(made, rrc_N_per_kN),
                           {{name_of_file(made.tire.name), scenarios::write_class_tire(made)}});
}

NewFiles make_new_tire(const NewTireOptions& options, const GuessOptions& log, const TireFitOptions& fit_options) {
  scenarios::ClassTire made = scenarios::make_class_tire(options);
  GuessOptions guess_options = log;
  guess_options.tire = made.base;  // only the kind of tire, for the size of loads and pressures
  if (guess_options.rig.empty()) guess_options.rig = "drum_2m";
  const measurements::Guess guess = measurements::guess_logs(guess_options, made.tire);
  measurements::Mapping mapping = read_guessed_mapping(guess);
  mapping.set.tire = made.tire;
  const measurements::Import imported = measurements::import_logs(mapping);
  TireFitOptions how = fit_options;
  how.name = made.tire.name;
  const TireFit fit = fit_tire(make_set(mapping, imported), how);
  put_fit(fit, made);
  const double rrc_N_per_kN = 1e3 * scenarios::simulate_iso_rrc(made.tire);
  std::vector<std::string> warnings = made.warnings;
  warnings.insert(warnings.end(), imported.warnings.begin(), imported.warnings.end());
  if (const auto warning = scenarios::check_iso_rrc(made.tire)) warnings.push_back(*warning);
  Json json = make_tire_json(made, rrc_N_per_kN);
  json["guesses"] = make_guess_json(guess)["guesses"];
  json["fit"] = Json::parse(fit.json);
  NewFiles files = make_files_report(
      format_new_tire(made, rrc_N_per_kN) + format_guesses(guess) + fit.text + format_warnings(warnings), json,
      {{name_of_file(made.tire.name), scenarios::write_class_tire(made)}});
  files.suspicion = fit.suspicion;
  return files;
}

NewFiles make_new_rig(const NewRigOptions& options) {
  const std::string toml = scenarios::write_new_rig(options);
  const rigs::RigFile rig = rigs::read_rig(parse_config(toml, "the new rig"));
  return make_files_report(fmt::format("new rig   {}   {}\n", rig.name, rig.kind->word),
                           {{"format", "rollrig-new-rig/1"}, {"rig", rig.name}}, {{name_of_file(rig.name), toml}});
}

NewFiles make_new_vehicle(const NewVehicleOptions& options) {
  const std::string toml = scenarios::write_new_vehicle(options);
  const rigs::VehicleFile vehicle = rigs::read_vehicle(parse_config(toml, "the new vehicle"));
  return make_files_report(fmt::format("new vehicle   {}   {:.5g} kg, {:.3f} m2\n", vehicle.name, vehicle.body.mass_kg,
                                       vehicle.body.drag_area_m2),
                           {{"format", "rollrig-new-vehicle/1"}, {"vehicle", vehicle.name}},
                           {{name_of_file(vehicle.name), toml}});
}

NewFiles guess_set(const GuessOptions& options, const std::string& folder) {
  const measurements::Guess guess = measurements::guess_logs(options);
  const bool is_set = measurements::are_files_of_set(guess);
  const FolderFiles files{
      {is_set ? "set.toml" : kMappingName,
       is_set ? measurements::write_guessed_set(guess, folder) : measurements::write_guessed_mapping(guess, folder)}};
  return make_files_report(fmt::format("new set   {}\n", options.folder) + format_guesses(guess),
                           make_guess_json(guess), files);
}

NewFiles import_guessed(const GuessOptions& options, const std::string& folder, BadRows bad_rows,
                        const Progress& progress) {
  const measurements::Guess guess = measurements::guess_logs(options);
  const Report imported = import_by_mapping(read_guessed_mapping(guess), bad_rows, progress);
  FolderFiles files = imported.make_files();
  files.emplace_back(kMappingName, measurements::write_guessed_mapping(guess, folder));
  Json json = Json::parse(imported.json);
  json["guesses"] = make_guess_json(guess)["guesses"];
  return make_files_report(format_guesses(guess) + imported.text, json, files);
}

}  // namespace rollrig
