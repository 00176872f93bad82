#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/scaffold.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

/// --out, --json, --force and --quiet of a command that writes one file.
struct NewFileOptions {
  std::string path;
  std::string json;
  bool force = false;
  bool quiet = false;

  void add_to(CLI::App& command, const char* doc) {
    add_output_option(command, "--out", path, doc);
    add_output_option(command, "--json", json, "File for the report, - for standard output");
    command.add_flag("--force", force, "Replace a file that is there");
    command.add_flag("--quiet", quiet, "Print nothing but errors");
  }
};

void require_free(const std::string& path, bool force) {
  if (path.empty() || path == "-" || force || !fs::exists(path)) return;
  throw usage_error(fmt::format("'{}' is there already", path), "--out", path,
                    "another file, or --force to replace it");
}

/// Writes the only file of a report, by default under its own name in a folder, then prints the report.
void write_new_file(const NewFiles& made, const NewFileOptions& options, const std::string& folder = "") {
  const FolderFiles files = made.make_files();
  const std::string path = !options.path.empty() ? options.path : (fs::path(folder) / files.front().first).string();
  require_free(path, options.force);
  const OutputFiles outputs({{"--out", path}, {"--json", options.json}});
  std::vector<StagedOutput> staged;
  const auto existing = options.force ? StagedOutput::Existing::kReplace : StagedOutput::Existing::kKeep;
  staged.emplace_back(path, files.front().second, existing);
  if (!options.json.empty()) staged.emplace_back(options.json, made.json);
  commit_all(staged);
  if (options.quiet || path == "-" || options.json == "-") return;
  std::cout << made.text << fmt::format("  written to {}\n", path);
}

struct NewTireCommand {
  NewTireOptions tire;
  GuessOptions log;
  TireFitOptions fit;
  NewFileOptions output;
};

int new_tire_command(const NewTireCommand& options) {
  require_free(options.output.path, options.output.force);
  if (options.log.folder.empty()) {
    write_new_file(make_new_tire(options.tire), options.output);
    return kDone;
  }
  NewFiles made;
  {  // its line is gone before the results are printed
    ProgressLine progress("new tire", options.output.quiet);
    TireFitOptions how = options.fit;
    how.progress = progress.callback();
    made = make_new_tire(options.tire, options.log, how);
  }
  write_new_file(made, options.output);
  return made.suspicion.empty() ? kDone : kDiffers;  // as of fit tire
}

void add_new_tire(CLI::App& parent, Action& action) {
  const auto [command, options] = add_command<NewTireCommand>(
      parent, action, "tire", "A tire from its size, load index and RRc, or a .tir file, with the values of its class",
      &new_tire_command);
  NewTireOptions& tire = options->tire;
  command->add_option("--size", tire.size, "Size, such as 205/55R16; a load index may follow")->required();
  command->add_option("--load-index", tire.load_index, "Load index, such as 91");
  command->add_option("--speed-symbol", tire.speed_symbol, "Speed symbol, such as V [that of the size]");
  auto* rrc = command->add_option("--rrc", tire.rrc_N_per_kN, "RRc of ISO 28580 in N/kN");
  auto* tir = command->add_option("--tir", tire.tir, "Tire property file (.tir) whose coefficients give the RRc");
  tir->excludes(rrc);
  command->add_option("--rrc-sd", tire.rrc_sd_N_per_kN, "Its standard uncertainty in N/kN [0.15]");
  command->add_option("--pressure", tire.pressure_kPa, "Gauge pressure of that test in kPa [of class C1 210 or 250]");
  command->add_option("--class", tire.tire_class, "Class [by size and load index]")
      ->check(CLI::IsMember({"C1", "C2", "C3"}));
  command->add_flag("--reinforced", tire.is_reinforced, "Extra load: tested at 250 kPa");
  command->add_option("--name", tire.name, "Name of the tire [from size and load index]");
  command->add_option("--warm-up", options->log.folder,
                      "Log of a warm-up, or a folder of such logs, to which the tire is fitted");
  add_guess_options(*command, options->log);
  add_threads(*command, options->fit.threads);
  options->output.add_to(*command, "File for the tire, - for standard output [<name>.toml]");
}

struct NewRigCommand {
  NewRigOptions rig;
  NewFileOptions output;
};

int new_rig_command(const NewRigCommand& options) {
  write_new_file(make_new_rig(options.rig), options.output);
  return kDone;
}

void add_new_rig(CLI::App& parent, Action& action) {
  const auto [command, options] = add_command<NewRigCommand>(
      parent, action, "rig", "A rig like the one of its kind in assets/rigs, with your numbers", &new_rig_command);
  NewRigOptions& rig = options->rig;
  command->add_option("--kind", rig.kind, "Kind of machine [drum]")
      ->check(CLI::IsMember({"drum", "flat_belt", "dyno"}));
  command->add_option("--name", rig.name, "Name of the rig [my_<kind>]");
  command->add_option("--diameter", rig.diameter_m, "Diameter of drum or roller in m");
  command->add_option("--inertia", rig.inertia_kg_m2, "Its moment of inertia in kg m2 [from the diameter]");
  command->add_option("--moving-mass", rig.moving_mass_kg, "Mass of a belt with its drums and motor in kg");
  command->add_option("--bearing-loss", rig.bearing_loss_N, "Loss without a tire at 80 km/h, at the surface, in N");
  command->add_option("--skim-load", rig.skim_load_N, "Load of the skim test in N");
  command->add_option("--ambient", rig.ambient_degC, "Usual temperature of the air in degC");
  options->output.add_to(*command, "File for the rig, - for standard output [<name>.toml]");
}

struct NewVehicleCommand {
  NewVehicleOptions vehicle;
  NewFileOptions output;
};

int new_vehicle_command(const NewVehicleCommand& options) {
  write_new_file(make_new_vehicle(options.vehicle), options.output);
  return kDone;
}

/// A, B, C times factors that take them to N, N/(km/h) and N/(km/h)^2.
void add_road_load(CLI::App& command, const std::string& option, NewVehicleOptions& vehicle, double newton, double km_h,
                   const char* doc) {
  const auto put = [&vehicle, newton, km_h](const std::vector<double>& abc) {
    vehicle.road_load = {newton * abc[0], newton / km_h * abc[1], newton / (km_h * km_h) * abc[2]};
  };
  command.add_option_function<std::vector<double>>(option, put, doc)->expected(3)->type_name("A B C");
}

void add_new_vehicle(CLI::App& parent, Action& action) {
  const auto [command, options] = add_command<NewVehicleCommand>(
      parent, action, "vehicle", "A vehicle of two axles from its mass, and its drag or road load",
      &new_vehicle_command);
  NewVehicleOptions& vehicle = options->vehicle;
  command->add_option("--mass", vehicle.mass_kg, "Mass as tested in kg")->required();
  command->add_option("--name", vehicle.name, "Name of the vehicle [my_vehicle]");
  command->add_option("--drag-area", vehicle.drag_area_m2, "Drag coefficient times frontal area in m2 [from C]");
  add_road_load(*command, "--abc", vehicle, 1.0, 1.0, "Road load in N, N/(km/h), N/(km/h)^2");
  add_road_load(*command, "--abc-lbf-mph", vehicle, kPoundForce_N, kMile_m / 1e3,
                "Road load in lbf, lbf/mph, lbf/mph^2");
  command->add_option("--rotating-mass", vehicle.rotating_mass_kg, "Of all rotating parts in kg [3 % of the mass]");
  command->add_option("--wheelbase", vehicle.wheelbase_m, "Between the axles in m [2.7]");
  command->add_option("--front-load-share", vehicle.front_load_share, "Share of the weight on the front axle [0.5]");
  command->add_option("--driven", vehicle.driven_axle, "Driven axle [rear]")
      ->check(CLI::IsMember({"front", "rear", "all"}));
  options->output.add_to(*command, "File for the vehicle, - for standard output [<name>.toml]");
}

struct NewSetCommand {
  GuessOptions logs;
  NewFileOptions output;
};

int new_set_command(const NewSetCommand& options) {
  const std::string& folder = options.logs.folder;
  const fs::path beside = fs::is_directory(folder) ? fs::path(folder) : fs::path(folder).parent_path();
  const fs::path of_file = options.output.path.empty() ? beside : fs::path(options.output.path).parent_path();
  write_new_file(guess_set(options.logs, of_file.string()), options.output, beside.string());
  return kDone;
}

void add_new_set(CLI::App& parent, Action& action) {
  const auto [command, options] = add_command<NewSetCommand>(
      parent, action, "set", "A mapping for import, or a set.toml, guessed from a folder of CSV files",
      &new_set_command);
  command->add_option("folder", options->logs.folder, "Folder of the logs, or one log")->required();
  add_guess_set_options(*command, options->logs);
  options->output.add_to(*command, "File for it, - for standard output [import.toml or set.toml in the folder]");
}

}  // namespace

void add_new_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("new", "Write a file for a tire, a rig, a vehicle or a set of your own");
  command->require_subcommand(1);
  add_new_tire(*command, action);
  add_new_rig(*command, action);
  add_new_vehicle(*command, action);
  add_new_set(*command, action);
}

}  // namespace rollrig::cli
