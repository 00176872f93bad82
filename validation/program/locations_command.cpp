#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "cli/progress.h"
#include "diagnosis/checks/set_checks.h"
#include "diagnosis/findings/locations.h"
#include "measurements/measurement_set.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
#include "validation/files.h"
#include "validation/generator/changes.h"
#include "validation/generator/validation_set.h"
#include "validation/program/commands.h"
#include "validation/scoring/locations.h"

namespace rollrig::validation {
namespace {

struct LocationsOptions {
  std::string set;
  int threads = 0;
};

/// The stretches that the diagnosis tells apart in a case, and what its effects change in each.
std::vector<TruePlace> find_places(const std::string& folder, const Json& truth) {
  const generator::SetOrder order = generator::read_order(truth);
  generator::require_same_files(folder, order);
  const measurements::MeasurementSet measured = measurements::read_measurement_set(folder);
  const diagnosis::PreparedSet set(diagnosis::leave_out(measured, diagnosis::check_set(measured, 1).left_out));
  const std::vector<diagnosis::LocationStretch> stretches = diagnosis::list_location_stretches(set);
  std::vector<generator::Place> places;
  for (const diagnosis::LocationStretch& at : stretches) places.push_back({at.channel, at.run, at.start_s, at.end_s});
  const std::vector<generator::ChangeAt> changes = generator::find_changes(order, places);
  std::vector<TruePlace> found;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const auto& [of_effects, after] = changes[i];
    found.push_back({stretches[i], of_effects.blocks, {of_effects.mean, of_effects.rms}, {after.mean, after.rms}});
  }
  return found;
}

int locations_command(const LocationsOptions& options) {
  const TruthFile truth = open_truth(options.set, "");
  const std::string out = place_in(options.set, kLocationsFile);
  require_writable(out);
  std::vector<std::string> numbers;
  for (const auto& [number, of] : truth.cases.items()) numbers.push_back(number);
  std::vector<Json> described(numbers.size());
  cli::ProgressLine line("validation", false);
  const auto describe = [&](std::size_t i) {
    described[i] = make_places_json(find_places(case_folder(options.set, numbers[i]), truth.cases.at(numbers[i])));
  };
  parallel_for(numbers.size(), options.threads, describe,
               [&line](double share_done) { line.update(share_done, "cases"); });
  Json json = {{"format", kLocationsFormat}, {"truth_sha256", truth.sha256}, {"sets", Json::object()}};
  for (std::size_t i = 0; i < numbers.size(); ++i) json["sets"][numbers[i]] = std::move(described[i]);
  throw_if_interrupted();
  write_output(out, to_text(json, 1));
  line.clear();
  std::cout << fmt::format("where the effects of {} cases act written to {}\n", numbers.size(), out);
  return cli::kDone;
}

}  // namespace

void add_locations_command(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<LocationsOptions>(
      app, action, "locations", "Open the truth: where the effects of each case change the readings, for the score",
      locations_command);
  add_set_to(*command, options->set);
  cli::add_threads(*command, options->threads, "Cases at a time [as many as there are cores]");
}

}  // namespace rollrig::validation
