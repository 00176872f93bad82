#include "fmu/wheel_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/core/error.h"

namespace rollrig::fmu {
namespace {

constexpr std::string_view kHeader = "rollrig-warm-wheel/2";

/// The lines of a text, one after the other.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  std::string_view take() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw RunFailure("the model of the wheel ends too soon");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  double take_number() { return convert<double>(); }
  int take_count() { return convert<int>(); }

 private:
  template <class Number>
  Number convert() {
    const std::string_view line = take();
    Number value{};
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc() || end != line.data() + line.size()) {
      throw RunFailure(fmt::format("the model of the wheel has '{}' where a number should be", line));
    }
    return value;
  }

  std::string_view rest_;
};

template <class Known>
const Known& find_known(const std::vector<const Known*>& all, std::string_view id) {
  for (const Known* known : all) {
    if (known->info.id == id) return *known;
  }
  throw RunFailure(fmt::format("the model of the wheel names '{}', which is not known", id));
}

/// Whether the law of a tire uses a number of [rolling_resistance].
bool law_uses(const models::TireParameters<double>& tire, std::string_view key) {
  const models::TireModelInfo& info = tire.model().info;
  if (!info.uses("rolling_resistance")) return false;
  if (key == "reference_drum_diameter_m") return info.loss_follows_curvature;
  if (key == "reference_pressure_kPa" || key == "pressure_exponent") return true;
  if (!info.has_speed_lines) return key == "reference_load_N";
  return key == "lowest_speed_km_h" || tire.load_map.empty();  // a map has loads and lines of its own
}

}  // namespace

bool WheelModel::uses(std::string_view name) const {
  const std::string table(name.substr(0, name.rfind('.')));
  const std::string_view key = name.substr(name.rfind('.') + 1);
  const auto has_effect = [this](std::string_view id) {
    return std::any_of(effects.begin(), effects.end(),
                       [id](const models::ActiveEffect& on) { return on.effect->info.id == id; });
  };
  // The rest of [geometry] and [stiffness] is for rigs of bodies, and for what a tire file leaves out.
  if (table == "geometry") return key == "outer_diameter_m" || key == "spin_inertia_kg_m2";
  if (table == "stiffness") return key == "vertical_N_per_m";
  if (table == "rolling_resistance") return law_uses(context.tire, key);
  if (name == "rig.machine_radius_m") return false;              // for a torque, which the wheel does not give
  if (name == "effects.cavity_volume.settling_s") return false;  // of a pressure sensor, as is the next of another
  if (name == "effects.surface_warming.skin_share") return false;
  if (name == "rig.moving_mass_kg") return has_effect("inertia_error");
  if (name == "rig.skim_load_N") return has_effect("tire_loss_in_skim");
  const bool is_of_wheel = table == "parasitic" || table == "rig" || table == "start" || table == "steps";
  return is_of_wheel || table.rfind("effects.", 0) == 0 || context.tire.model().info.uses(table);
}

std::uint64_t calc_checksum(const char* bytes, std::size_t size) {
  std::uint64_t sum = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i) sum = (sum ^ static_cast<unsigned char>(bytes[i])) * 1099511628211u;
  return sum;
}

std::string write_wheel_model(const WheelModel& model) {
  const models::TireParameters<double>& tire = model.context.tire;
  const models::MachineTraits& machine = model.context.machine;
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", kHeader, model.tire, tire.model().info.id,
                                 tire.own.values.size(), tire.load_map.size());
  text += fmt::format("{}\n{}\n{}\n{}\n", static_cast<int>(machine.surface), static_cast<int>(machine.specimen),
                      static_cast<int>(machine.restraint), machine.force.header());
  text += fmt::format("{}\n", model.effects.size());
  for (const models::ActiveEffect& on : model.effects) text += on.effect->info.id + "\n";
  text += fmt::format("{}\n{}\n", model.load_N, model.ambient_K);
  WheelModel::visit(model, [&text](const std::string&, const Field&, double value) {
    text += fmt::format("{}\n", value);  // the shortest text that is this number
  });
  return text;
}

WheelModel read_wheel_model(std::string_view text) {
  LineReader lines(text);
  if (lines.take() != kHeader) throw RunFailure("there is no model of a wheel, or one of another version");
  WheelModel model;
  model.tire = lines.take();
  models::TireParameters<double>& tire = model.context.tire;
  tire.own.model = &find_known(models::all_tire_models(), lines.take());
  tire.own.values.resize(static_cast<std::size_t>(lines.take_count()));
  tire.load_map.resize(static_cast<std::size_t>(lines.take_count()));
  models::MachineTraits& machine = model.context.machine;
  machine.surface = static_cast<models::Surface>(lines.take_count());
  machine.specimen = static_cast<models::Specimen>(lines.take_count());
  machine.restraint = static_cast<models::Restraint>(lines.take_count());
  machine.force = intern_quantity(std::string(lines.take()));
  const int effects = lines.take_count();
  for (int i = 0; i < effects; ++i) {
    const models::Effect& effect = find_known(models::all_effects(), lines.take());
    model.effects.push_back({&effect, std::vector<double>(effect.info.parameters.size())});
  }
  model.load_N = lines.take_number();
  model.ambient_K = lines.take_number();
  WheelModel::visit(model, [&lines](const std::string&, const Field&, double& value) { value = lines.take_number(); });
  return model;
}

}  // namespace rollrig::fmu
