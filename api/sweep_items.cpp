#include "api/sweep_items.h"

#include <filesystem>

#include "api/data.h"
#include "api/run_items.h"
#include "rollrig/version.h"
#include "sim/core/file_io.h"

namespace rollrig {

Json SweepItems::describe(std::size_t item) const {
  Json varied = Json::object();
  for (std::size_t a = 0; a < input_.axes.size(); ++a) varied[input_.axes[a].key] = points_[item][a];
  return varied;
}

Json SweepItems::carry_out(std::size_t item, std::uint64_t) const {
  const ReadRecorder recorder;
  const scenarios::RunSpec spec = read(item);
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  if (!input_.unfinished_folder.empty()) require_known(recorder.list_files());
  return {{"result", outcome.result}, {"manifest", scenarios::make_manifest(spec, outcome)}};
}

scenarios::RunSpec SweepItems::read(std::size_t item) const {
  RunInput run = input_.run;
  for (std::size_t a = 0; a < input_.axes.size(); ++a) {
    set_factor(input_.axes[a].key, points_[item][a], run);
  }
  return read_run(run);
}

scenarios::RunSpec SweepItems::prepare(std::size_t item) const {
  try {
    scenarios::RunSpec spec = read(item);
    scenarios::prepare_run(spec);
    return spec;
  } catch (const InputError& error) {
    for (const SweepAxis& axis : input_.axes) {
      if (is_of_factor(error, axis.key)) throw_of_option(error, "--vary");
    }
    throw;
  }
}

void SweepItems::require_one_spelling(const std::string& path, const std::string& given) {
  const auto [known, is_new] = tire_files_.emplace(std::filesystem::weakly_canonical(path), given);
  if (is_new || known->second == given) return;
  throw InputError({"a tire is varied twice", "command line", 0, "--vary", fmt::format("{}, {}", known->second, given),
                    "each tire file once", ""});
}

void SweepItems::check() {
  const ReadRecorder recorder;
  for (std::size_t item = 0; item < count(); ++item) {
    const scenarios::RunSpec spec = prepare(item);
    for (std::size_t a = 0; a < input_.axes.size(); ++a) {
      if (input_.axes[a].key != kTireFactor) continue;
      tire_names_[points_[item][a]] = spec.tire.name;
      require_one_spelling(spec.tire.path, points_[item][a]);
    }
  }
  if (!input_.unfinished_folder.empty()) carry_out_quickly(read(0));
  files_ = hash_files(recorder.list_files());
  watch_files(files_);
}

std::vector<SweepPoint> SweepItems::list_shown_points() const {
  std::map<std::string, std::size_t> uses;  // two files may give one name
  for (const auto& [given, name] : tire_names_) ++uses[name];
  std::vector<SweepPoint> shown = points_;
  for (SweepPoint& point : shown) {
    for (std::size_t a = 0; a < input_.axes.size(); ++a) {
      if (input_.axes[a].key != kTireFactor) continue;
      const std::string& name = tire_names_.at(point[a]);
      if (uses.at(name) == 1) point[a] = name;
    }
  }
  return shown;
}

std::string SweepItems::define(std::uint64_t seed) const {
  CampaignDefinition definition;
  definition.version = library_version();
  definition.sources = library_sources();
  definition.run = input_.run;
  definition.files = files_;
  definition.design.name = campaigns::kGrid;
  definition.design.seed = seed;
  for (const SweepAxis& axis : input_.axes) {
    definition.design.factors.push_back({axis.key, campaigns::Factor::Kind::kValues, axis.values});
  }
  return definition.to_text();
}

}  // namespace rollrig
