#include "fmu/wheel_model.h"

#include <fmt/format.h>

#include <charconv>

#include "sim/core/error.h"

namespace rollrig::fmu {
namespace {

constexpr std::string_view kHeader = "rollrig-warm-wheel/1";

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

}  // namespace

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
