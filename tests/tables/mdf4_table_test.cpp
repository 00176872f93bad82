// MDF4 files made block by block, as the format describes them. Files of other programs are not in the repository;
// docs/import.md says with which ones the reader was tried.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sim/core/error.h"
#include "tables/log_table.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using rollrig::tables::LogTable;
using rollrig::tables::read_log_table;
using rollrig::tests::TemporaryFolder;

namespace {

using Links = std::vector<std::uint64_t>;

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A file that grows from its last blocks to its first one, the header, whose place is fixed.
class Mdf4Maker {
 public:
  Mdf4Maker() : bytes_("MDF     4.10    test    ") { bytes_.resize(64 + 24 + 6 * 8 + 32, '\0'); }

  std::uint64_t add(const std::string& name, const Links& links, const std::string& data) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
    const std::uint64_t at = bytes_.size();
    bytes_ += make_block(name, links, data);
    return at;
  }
  std::uint64_t add_text(const std::string& text) { return add("TX", {}, text + '\0'); }

  struct Channel {
    std::string name;
    int type = 0;  // 2 master
    int data_type = 0;
    std::uint32_t byte = 0;
    std::uint32_t bits = 0;
    std::uint64_t conversion = 0;
    std::uint32_t flags = 0;
    std::uint64_t composition = 0;
  };
  std::uint64_t add_channels(const std::vector<Channel>& channels) {
    std::uint64_t next = 0;
    for (auto channel = channels.rbegin(); channel != channels.rend(); ++channel) {
      const std::string data = raw(static_cast<std::uint8_t>(channel->type)) + '\0' +
                               raw(static_cast<std::uint8_t>(channel->data_type)) + '\0' + raw(channel->byte) +
                               raw(channel->bits) + raw(channel->flags) + raw(std::uint32_t{0}) + std::string(52, '\0');
      next =
          add("CN", {next, channel->composition, add_text(channel->name), 0, channel->conversion, 0, add_text("s"), 0},
              data);
    }
    return next;
  }
  std::uint64_t add_group(std::uint64_t next, std::uint64_t channels, std::uint64_t id, std::uint64_t count,
                          std::uint32_t bytes, std::uint32_t invalidation_bytes = 0) {
    return add("CG", {next, channels, 0, 0, 0, 0},
               raw(id) + raw(count) + std::string(8, '\0') + raw(bytes) + raw(invalidation_bytes));
  }

  /// `at` are the attachments.
  std::string finish(std::uint64_t group, std::uint64_t data, std::uint8_t id_bytes, std::uint64_t at = 0) {
    const std::uint64_t first = add("DG", {0, group, data, 0}, raw(id_bytes) + std::string(7, '\0'));
    bytes_.replace(64, 24 + 6 * 8 + 32, make_block("HD", {first, 0, 0, at, 0, 0}, std::string(32, '\0')));
    return bytes_;
  }

 private:
  static std::string make_block(const std::string& name, const Links& links, const std::string& data) {
    std::string block =
        "##" + name + std::string(4, '\0') + raw(24 + 8 * links.size() + data.size()) + raw(links.size());
    for (const std::uint64_t link : links) block += raw(link);
    return block + data;
  }

  std::string bytes_;
};

constexpr int kMade = 100;

/// Time as double, temperature as int16 in 0.1 K from -40, a counter as big-endian uint16: 12 bytes.
std::string make_record(int row) {
  return raw(0.5 * row) + raw(static_cast<std::int16_t>(row - 50)) + static_cast<char>(row >> 8) +
         static_cast<char>(row);
}
std::string make_records() {
  std::string records;
  for (int row = 0; row < kMade; ++row) records += make_record(row);
  return records;
}

std::vector<Mdf4Maker::Channel> make_channels(Mdf4Maker& maker) {
  const std::uint64_t conversion =
      maker.add("CC", {0, 0, 0, 0}, std::string("\1\0\0\0\0\0\2\0", 8) + std::string(16, '\0') + raw(-40.0) + raw(0.1));
  return {{"time", 2, 4, 0, 64}, {"temperature", 0, 2, 8, 16, conversion}, {"counter", 0, 1, 10, 16}};
}

std::string compress_block(const std::string& bytes, bool is_transposed) {
  constexpr std::size_t kWidth = 12;
  std::string plain = bytes;
  const std::size_t rows = bytes.size() / kWidth;
  for (std::size_t i = 0; is_transposed && i < rows * kWidth; ++i) plain[i % kWidth * rows + i / kWidth] = bytes[i];
  uLongf size = compressBound(plain.size());
  std::string packed(size, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
                   plain.size()) == Z_OK);
  packed.resize(size);
  return std::string("DT") + (is_transposed ? '\1' : '\0') + '\0' + raw(static_cast<std::uint32_t>(kWidth)) +
         raw(std::uint64_t{bytes.size()}) + raw(std::uint64_t{packed.size()}) + packed;
}

LogTable read_made(const std::string& bytes, const std::string& key) {
  const TemporaryFolder folder;
  rollrig::tests::write_file(folder.file("a.mf4"), bytes);
  return read_log_table(folder.file("a.mf4"), {}, key);
}

std::string find_what(const std::string& bytes, const std::string& key) {
  try {
    read_made(bytes, key);
  } catch (const InputError& error) {
    return error.problem().what;
  }
  return "";
}

void check_table(const LogTable& table) {
  REQUIRE(table.rows.row_count() == kMade);
  const std::vector<double> time_s = table.rows.plain_numbers("time", {});
  const std::vector<double> temperature = table.rows.plain_numbers("temperature", {});
  const std::vector<double> counter = table.rows.plain_numbers("counter", {});
  double worst = 0.0;
  for (int row = 0; row < kMade; ++row) {
    const auto i = static_cast<std::size_t>(row);
    worst = std::max({worst, std::abs(time_s[i] - 0.5 * row), std::abs(counter[i] - row),
                      std::abs(temperature[i] - (-45.0 + 0.1 * row))});
  }
  CHECK(worst < 1e-9);
  CHECK(table.units.at("time") == "s");
}

}  // namespace

TEST_CASE("records of MDF4 are read plain, compressed, transposed and in parts", "[fast]") {
  const std::string records = make_records();
  for (const std::string how : {"plain", "compressed", "transposed", "in parts"}) {
    INFO(how);
    Mdf4Maker maker;
    const std::uint64_t group = maker.add_group(0, maker.add_channels(make_channels(maker)), 0, kMade, 12);
    std::uint64_t data = 0;
    if (how == "plain") {
      data = maker.add("DT", {}, records);
    } else if (how == "in parts") {
      const std::size_t half = records.size() / 2 + 5;  // within a record
      const std::uint64_t first = maker.add("DZ", {}, compress_block(records.substr(0, half), true));
      const std::uint64_t second = maker.add("DT", {}, records.substr(half));
      const std::uint64_t last_list = maker.add("DL", {0, second}, std::string(24, '\0'));
      const std::uint64_t list = maker.add("DL", {last_list, first}, std::string(24, '\0'));
      data = maker.add("HL", {list}, std::string(8, '\0'));
    } else {
      data = maker.add("DZ", {}, compress_block(records, how == "transposed"));
    }
    check_table(read_made(maker.finish(group, data, 0), "time"));
  }
}

TEST_CASE("unsorted records of two groups are told apart, and channels of one name too", "[fast]") {
  Mdf4Maker maker;
  const std::uint64_t second =
      maker.add_group(0, maker.add_channels({{"time", 2, 4, 0, 64}, {"speed", 0, 4, 8, 32}}), 9, 3, 12);
  const std::uint64_t first = maker.add_group(second, maker.add_channels(make_channels(maker)), 7, kMade, 12);
  std::string records;
  for (int row = 0; row < kMade; ++row) {
    records += '\7' + make_record(row);
    if (row % 40 == 0) records += '\x9' + raw(1.0 * row) + raw(1.5F * static_cast<float>(row));
  }
  const std::string file = maker.finish(first, maker.add("DT", {}, records), 1);
  const LogTable table = read_made(file, "2/time");
  CHECK(table.rows.plain_numbers("speed", {}) == std::vector<double>{0.0, 60.0, 120.0});
  CHECK_FALSE(table.rows.has("counter"));
  CHECK(read_made(file, "1/time").rows.plain_numbers("counter", {}).back() == kMade - 1);
}

TEST_CASE("a value that its record marks as invalid is missing", "[fast]") {
  Mdf4Maker maker;
  const std::uint64_t group =
      maker.add_group(0, maker.add_channels({{"time", 2, 4, 0, 64}, {"speed", 0, 0, 8, 8, 0, 2}}), 0, 3, 9, 1);
  std::string records;
  for (int row = 0; row < 3; ++row)
    records += raw(1.0 * row) + static_cast<char>(80 + row) + static_cast<char>(row == 1);
  const std::vector<double> speed =
      read_made(maker.finish(group, maker.add("DT", {}, records), 0), "time").rows.plain_numbers("speed", {});
  CHECK(speed[0] == 80.0);
  CHECK(std::isnan(speed[1]));
  CHECK(speed[2] == 82.0);
}

TEST_CASE("what is not read of MDF4 is refused, or named", "[fast]") {
  Mdf4Maker maker;
  std::vector<Mdf4Maker::Channel> channels = make_channels(maker);
  channels[1].composition = maker.add("CA", {0}, std::string(24, '\0'));
  const std::uint64_t group = maker.add_group(0, maker.add_channels(channels), 0, kMade, 12);
  const std::string file = maker.finish(group, maker.add("DT", {}, make_records()), 0);
  const LogTable table = read_made(file, "time");
  CHECK(table.not_read == std::set<std::string>{"temperature"});
  CHECK(table.rows.has("counter"));

  Mdf4Maker attached;
  const std::uint64_t attachment = attached.add("AT", {0, 0, 0, 0}, std::string(40, '\0'));
  CHECK_THAT(find_what(attached.finish(0, 0, 0, attachment), "time"), Catch::Contains("attachments"));
  std::string unfinished = file;
  unfinished.replace(0, 8, "UnFinMF ");
  CHECK_THAT(find_what(unfinished, "time"), Catch::Contains("not brought to its end"));
  std::string old = file;
  old.replace(8, 4, "3.30");
  CHECK_THAT(find_what(old, "time"), Catch::Contains("another version"));
}

TEST_CASE("an MDF4 file that is cut off, or goes round in circles, is refused", "[fast]") {
  Mdf4Maker maker;
  const std::uint64_t group = maker.add_group(0, maker.add_channels(make_channels(maker)), 0, kMade, 12);
  const std::string file = maker.finish(group, maker.add("DZ", {}, compress_block(make_records(), true)), 0);
  for (std::size_t part = 1; part < 12; ++part) {
    CHECK(find_what(file.substr(0, file.size() * part / 12), "time") == "a damaged MDF4 file");
  }
  std::string round = file;
  round.replace(group + 24, 8, raw(std::uint64_t{group}));  // the next group is this one
  CHECK(find_what(round, "time") == "a damaged MDF4 file");
}
