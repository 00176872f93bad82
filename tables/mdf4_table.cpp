#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tables/formats.h"
#include "tables/mdf4_blocks.h"

namespace rollrig::tables {
namespace {

constexpr int kMostBlocks = 100'000;  // of a list; more are a list that goes round

/// A channel of numbers in the records of its group.
struct Mdf4Channel {
  std::string name;
  std::string unit;
  std::uint8_t data_type = 0;  // 0 to 5: unsigned, signed, float; little- or big-endian
  std::uint8_t bit_offset = 0;
  std::uint32_t byte_offset = 0;
  std::uint32_t bits = 0;
  bool is_virtual = false;  // its value is the number of the record
  bool is_invalid = false;
  std::optional<std::uint32_t> invalidation_bit;
  double factor = 1.0;
  double offset = 0.0;
};

struct Mdf4Group {
  std::uint64_t id = 0;
  std::uint64_t count = 0;
  std::uint32_t data_bytes = 0;
  std::uint32_t invalidation_bytes = 0;
  bool is_of_texts = false;  // records of variable length
  std::vector<Mdf4Channel> channels;
  std::string records;

  std::size_t size() const { return data_bytes + std::size_t{invalidation_bytes}; }
};

/// A linear conversion, or none. False for any other.
bool read_conversion(const Mdf4Bytes& file, std::uint64_t at, Mdf4Channel& channel) {
  if (at == 0) return true;
  const Mdf4Block block(file, at, {"CC"});
  if (channel.unit.empty()) channel.unit = read_mdf4_text(file, block.link(1));
  const auto type = block.get<std::uint8_t>(0);
  if (type == 0) return true;
  if (type != 1) return false;
  channel.offset = block.get<double>(24);
  channel.factor = block.get<double>(32);
  return true;
}

/// None for a channel of texts, arrays, structures, or with a conversion that is not linear.
std::optional<Mdf4Channel> read_channel(const Mdf4Bytes& file, const Mdf4Block& block) {
  enum : std::uint8_t { kFixed = 0, kMaster = 2, kVirtualMaster = 3, kSync = 4, kVirtual = 6 };
  const auto type = block.get<std::uint8_t>(0);
  Mdf4Channel channel;
  channel.name = read_mdf4_text(file, block.link(2));
  channel.unit = read_mdf4_text(file, block.link(6));
  channel.is_virtual = type == kVirtualMaster || type == kVirtual;
  const bool has_numbers = type == kFixed || type == kMaster || type == kSync || channel.is_virtual;
  channel.data_type = block.get<std::uint8_t>(2);
  channel.bit_offset = block.get<std::uint8_t>(3);
  channel.byte_offset = block.get<std::uint32_t>(4);
  channel.bits = block.get<std::uint32_t>(8);
  const auto flags = block.get<std::uint32_t>(12);
  channel.is_invalid = (flags & 1U) != 0;
  if ((flags & 2U) != 0) channel.invalidation_bit = block.get<std::uint32_t>(16);
  const bool is_float = channel.data_type == 4 || channel.data_type == 5;
  const bool is_readable = channel.is_virtual || (channel.data_type <= 5 && channel.bits >= 1 && channel.bits <= 64 &&
                                                  channel.bit_offset <= 7 && channel.bit_offset + channel.bits <= 64 &&
                                                  (!is_float || channel.bits == 32 || channel.bits == 64));
  if (!has_numbers || !is_readable || block.link(1) != 0 || channel.name.empty()) return std::nullopt;
  if (!read_conversion(file, block.link(4), channel)) return std::nullopt;
  return channel;
}

Mdf4Group read_group(const Mdf4Bytes& file, const Mdf4Block& block, std::vector<std::string>& left_out) {
  Mdf4Group group;
  group.id = block.get<std::uint64_t>(0);
  group.count = block.get<std::uint64_t>(8);
  group.is_of_texts = (block.get<std::uint16_t>(16) & 1U) != 0;
  group.data_bytes = block.get<std::uint32_t>(24);
  group.invalidation_bytes = block.get<std::uint32_t>(28);
  int channels = 0;
  for (std::uint64_t at = block.link(1); at != 0;) {
    if (++channels > kMostBlocks) throw Mdf4Damaged();
    const Mdf4Block channel(file, at, {"CN"});
    if (const auto read = read_channel(file, channel); read.has_value()) {
      group.channels.push_back(*read);
    } else {
      left_out.push_back(read_mdf4_text(file, channel.link(2)));
    }
    at = channel.link(0);
  }
  return group;
}

/// Records of several groups, one after the other, each with the number of its group before it.
void sort_records(const std::string& records, std::uint8_t id_bytes, std::vector<Mdf4Group>& groups) {
  std::map<std::uint64_t, Mdf4Group*> by_id;
  for (Mdf4Group& group : groups) by_id[group.id] = &group;
  for (std::size_t at = 0; at < records.size();) {
    std::uint64_t id = 0;
    if (records.size() - at < id_bytes) throw Mdf4Damaged();
    std::memcpy(&id, records.data() + at, id_bytes);
    at += id_bytes;
    const auto found = by_id.find(id);
    if (found == by_id.end()) throw Mdf4Damaged();
    std::size_t size = found->second->size();
    if (found->second->is_of_texts) {
      std::uint32_t length = 0;
      if (records.size() - at < sizeof length) throw Mdf4Damaged();
      std::memcpy(&length, records.data() + at, sizeof length);
      size = sizeof length + length;
    }
    if (records.size() - at < size) throw Mdf4Damaged();
    if (!found->second->is_of_texts) found->second->records.append(records, at, size);
    at += size;
  }
}

double decode(const Mdf4Channel& channel, const char* record) {
  const bool is_big = channel.data_type % 2 == 1;
  const std::uint32_t bytes = (channel.bit_offset + channel.bits + 7) / 8;
  std::uint64_t raw = 0;
  for (std::uint32_t i = 0; i < bytes; ++i) {
    const auto byte = static_cast<unsigned char>(record[channel.byte_offset + (is_big ? i : bytes - 1 - i)]);
    raw = (raw << 8U) | byte;
  }
  raw >>= channel.bit_offset;
  if (channel.bits < 64) raw &= (1ULL << channel.bits) - 1;
  if (channel.data_type >= 4) {
    if (channel.bits == 64) {
      double value = 0.0;
      std::memcpy(&value, &raw, sizeof value);
      return value;
    }
    const auto narrow = static_cast<std::uint32_t>(raw);
    float value = 0.0F;
    std::memcpy(&value, &narrow, sizeof value);
    return static_cast<double>(value);
  }
  if (channel.data_type < 2) return static_cast<double>(raw);
  if (channel.bits < 64 && (raw >> (channel.bits - 1)) != 0) raw |= ~((1ULL << channel.bits) - 1);
  return static_cast<double>(static_cast<std::int64_t>(raw));
}

std::vector<double> read_values(const Mdf4Group& group, const Mdf4Channel& channel) {
  const std::uint64_t last = channel.byte_offset + (channel.bit_offset + channel.bits + 7ULL) / 8;
  if (!channel.is_virtual && last > group.data_bytes) throw Mdf4Damaged();
  std::vector<double> values(group.count);
  for (std::size_t row = 0; row < values.size(); ++row) {
    const char* record = group.records.data() + row * group.size();
    const double raw = channel.is_virtual ? static_cast<double>(row) : decode(channel, record);
    values[row] = channel.offset + channel.factor * raw;
    if (!channel.invalidation_bit.has_value()) continue;
    const std::uint32_t byte = *channel.invalidation_bit / 8;
    if (byte >= group.invalidation_bytes) throw Mdf4Damaged();
    const auto bits = static_cast<unsigned char>(record[group.data_bytes + byte]);
    if (((bits >> (*channel.invalidation_bit % 8)) & 1U) != 0) values[row] = std::nan("");
  }
  return values;
}

/// The groups of a data group, with their records.
std::vector<Mdf4Group> read_data_group(const Mdf4Bytes& file, const Mdf4Block& block,
                                       std::vector<std::string>& left_out) {
  std::vector<Mdf4Group> groups;
  for (std::uint64_t at = block.link(1); at != 0;) {
    const Mdf4Block group(file, at, {"CG"});
    groups.push_back(read_group(file, group, left_out));
    at = group.link(0);
    if (groups.size() > kMostBlocks) throw Mdf4Damaged();
  }
  const auto id_bytes = block.get<std::uint8_t>(0);
  if (id_bytes > 8 || (id_bytes == 0 && groups.size() > 1)) throw Mdf4Damaged();
  std::string records = read_mdf4_records(file, block.link(2));
  if (id_bytes > 0) {
    sort_records(records, id_bytes, groups);
  } else if (!groups.empty()) {
    groups.front().records = std::move(records);
  }
  return groups;
}

/// Channels that are in one group alone have their own names; others have the number of the group before them.
void add_columns(const std::vector<Mdf4Group>& groups, Columns& columns) {
  std::map<std::string, int> times;
  for (const Mdf4Group& group : groups) {
    for (const Mdf4Channel& channel : group.channels) ++times[channel.name];
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Mdf4Group& group = groups[i];
    if (group.count < 2 || group.is_of_texts) continue;
    if (group.size() > 0 && group.records.size() / group.size() < group.count) throw Mdf4Damaged();
    const std::string prefix = fmt::format("{}/", i + 1);
    std::map<std::string, int> own;
    for (const Mdf4Channel& channel : group.channels) {
      if (channel.is_invalid || ++own[channel.name] > 1) continue;
      const std::string name = times[channel.name] > 1 ? prefix + channel.name : channel.name;
      columns.push_back({name, prefix, read_values(group, channel), static_cast<int>(i) + 1, channel.unit});
    }
  }
}

Columns read_blocks(const Mdf4Bytes& file, const std::string& path) {
  if (file.text(0, 8) != "MDF     ") {
    throw InputError({"a recording of MDF4 that was not brought to its end", path, 0, "", file.text(0, 8),
                      "a finalized file: \"MDF     \" at its start", ""});
  }
  if (file.text(8, 2) != "4.") {
    throw InputError({"MDF of another version", path, 0, "", file.text(8, 4), "version 4", ""});
  }
  constexpr std::uint64_t kHeader = 64;
  const Mdf4Block header(file, kHeader, {"HD"});
  if (header.link(3) != 0) {
    throw InputError(
        {"the file has attachments, which are not read", path, 0, "", "", "a file without attachments", ""});
  }
  std::vector<Mdf4Group> groups;
  std::vector<std::string> left_out;
  int count = 0;
  for (std::uint64_t at = header.link(0); at != 0;) {
    if (++count > kMostBlocks) throw Mdf4Damaged();
    const Mdf4Block block(file, at, {"DG"});
    for (Mdf4Group& group : read_data_group(file, block, left_out)) groups.push_back(std::move(group));
    at = block.link(0);
  }
  Columns columns;
  add_columns(groups, columns);
  for (const std::string& name : left_out) {
    if (!name.empty()) columns.push_back({name, "", std::vector<double>()});
  }
  return columns;
}

}  // namespace

Columns read_mdf4(const std::string& path) {
  try {
    return read_blocks(Mdf4Bytes(read_binary_file(path)), path);
  } catch (const Mdf4Damaged&) {
    throw InputError({"a damaged MDF4 file", path, 0, "", "", "a whole file, as its program wrote it", ""});
  }
}

}  // namespace rollrig::tables
