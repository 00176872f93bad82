#include "rigs/machine.h"

#include <algorithm>
#include <stdexcept>

namespace rollrig::rigs {

// Named one by one, since the linker drops objects of a static library that nothing refers to.
#define ROLLRIG_MACHINE(word) const MachineKind& machine_##word();
#include "rigs/machines.def"
#undef ROLLRIG_MACHINE

namespace {

void add_once(const Quantity& quantity, std::vector<Quantity>& quantities) {
  if (std::find(quantities.begin(), quantities.end(), quantity) == quantities.end()) quantities.push_back(quantity);
}

template <class Shows>
std::vector<std::string> list_headings(const std::vector<Quantity>& quantities, const Shows& shows) {
  std::vector<Quantity> found;
  for (const Quantity& quantity : quantities) {
    for (const MachineKind* kind : machine_kinds()) {
      const bool is_force = quantity == models::quantities::kMachineForce;
      if (shows(kind->traits)) add_once(is_force ? kind->traits.force : quantity, found);
    }
  }
  return list_headers(found);
}

}  // namespace

std::vector<Column> RunColumns::all_given() const {
  std::vector<Column> columns = given;
  columns.insert(columns.end(), optional_given.begin(), optional_given.end());
  return columns;
}

std::vector<Column> RunColumns::all() const {
  std::vector<Column> columns = all_given();
  columns.insert(columns.end(), measured.begin(), measured.end());
  return columns;
}

Column columns::measure(const Quantity& tire_channel) {
  const models::TireChannel& channel = models::get_tire_channel(tire_channel);
  return {channel.quantity, channel.family.range, channel.doc};
}

models::SensorSet::value_type columns::make_usual_sensor(const Quantity& tire_channel) {
  const models::TireChannel& channel = models::get_tire_channel(tire_channel);
  return {channel.quantity, channel.usual_sensor};
}

const std::vector<const MachineKind*>& machine_kinds() {
  static const std::vector<const MachineKind*> all{
#define ROLLRIG_MACHINE(word) &machine_##word(),
#include "rigs/machines.def"
#undef ROLLRIG_MACHINE
  };
  return all;
}

std::vector<std::string> machine_words() { return list_machines(&models::is_any); }

std::vector<std::string> set_words() {
  std::vector<std::string> words;
  for (const MachineKind* kind : machine_kinds()) words.emplace_back(kind->set_word);
  return words;
}

const MachineKind* find_machine_kind_if_any(const std::string& word) {
  for (const MachineKind* kind : machine_kinds()) {
    if (!word.empty() && (word == kind->word || word == kind->former_word || word == kind->set_word)) return kind;
  }
  return nullptr;
}

const MachineKind& find_machine_kind(const std::string& word) {
  if (const MachineKind* kind = find_machine_kind_if_any(word)) return *kind;
  throw std::invalid_argument("no kind of machine '" + word + "'");
}

const MachineKind& find_kind_without_rig(bool (*has_trait)(const models::MachineTraits&)) {
  for (const MachineKind* kind : machine_kinds()) {
    if (!kind->names_rig() && has_trait(kind->traits)) return *kind;
  }
  throw std::invalid_argument("no kind of machine with this trait goes without a rig");
}

bool is_force(const Quantity& column) {
  return std::any_of(machine_kinds().begin(), machine_kinds().end(),
                     [&](const MachineKind* kind) { return kind->traits.force == column; });
}

std::vector<Quantity> measured_channels(const MachineKind& kind) {
  std::vector<Quantity> channels;
  for (const Column& column : kind.columns.measured) channels.push_back(column.quantity);
  return channels;
}

std::vector<Quantity> all_measured_channels() {
  std::vector<Quantity> channels;
  for (const MachineKind* kind : machine_kinds()) {
    for (const Quantity& channel : measured_channels(*kind)) add_once(channel, channels);
  }
  return channels;
}

std::vector<std::string> list_machines(bool (*has_trait)(const models::MachineTraits&)) {
  std::vector<std::string> words;
  for (const MachineKind* kind : machine_kinds()) {
    if (has_trait(kind->traits)) words.emplace_back(kind->word);
  }
  return words;
}

std::vector<std::string> list_visible(const models::EffectInfo& effect) {
  return list_headings(effect.visible_in,
                       [&](const models::MachineTraits& machine) { return is_seen_on(effect, machine); });
}

std::vector<std::string> list_clean(const models::EffectInfo& effect) {
  return list_headings(effect.clean_in, effect.acts_on);
}

}  // namespace rollrig::rigs
