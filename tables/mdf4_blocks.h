#pragma once
/// Blocks of an MDF4 file, with every place checked before it is read.

#include <cstdint>
#include <string>
#include <vector>

namespace rollrig::tables {

/// What is thrown within the reader for a file that contradicts itself.
struct Mdf4Damaged {};

/// The bytes of a file, little-endian.
class Mdf4Bytes {
 public:
  explicit Mdf4Bytes(std::string bytes) : bytes_(std::move(bytes)) {}

  /// A number of type T at a place. Throws Mdf4Damaged beyond the end.
  template <class T>
  T get(std::uint64_t at) const;
  std::string text(std::uint64_t at, std::uint64_t size) const;

 private:
  const char* place(std::uint64_t at, std::uint64_t size) const;

  std::string bytes_;
};

/// A block: a header, links to other blocks, data.
class Mdf4Block {
 public:
  /// Throws Mdf4Damaged where there is no block whose name is among `names`, such as "DT".
  Mdf4Block(const Mdf4Bytes& file, std::uint64_t at, const std::vector<std::string>& names);

  const std::string& name() const { return name_; }
  std::uint64_t link_count() const { return links_; }
  /// 0 where the link is empty, or not there.
  std::uint64_t link(std::uint64_t index) const;
  template <class T>
  T get(std::uint64_t at) const {
    return file_.get<T>(data_ + at);
  }
  /// All data from a place on.
  std::string rest(std::uint64_t at = 0) const;

 private:
  const Mdf4Bytes& file_;
  std::string name_;
  std::uint64_t at_;
  std::uint64_t size_;
  std::uint64_t links_;
  std::uint64_t data_;
};

/// The text of a TX block, or of an MD block its element TX; empty without a block.
std::string read_mdf4_text(const Mdf4Bytes& file, std::uint64_t at);

/// The records of a data group, from DT, DZ, DL and HL blocks.
std::string read_mdf4_records(const Mdf4Bytes& file, std::uint64_t at);

}  // namespace rollrig::tables
