#include "tables/mdf4_blocks.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace rollrig::tables {
namespace {

/// Bytes of a compressed block.
std::string inflate_block(const Mdf4Block& block) {
  constexpr std::uint64_t kHeader = 24;
  constexpr std::uint64_t kMost = 1ULL << 31U;
  const auto type = block.get<std::uint8_t>(2);
  const auto width = block.get<std::uint32_t>(4);
  const auto size = block.get<std::uint64_t>(8);
  const auto packed_size = block.get<std::uint64_t>(16);
  const std::string packed = block.rest(kHeader).substr(0, packed_size);
  if (size > kMost || packed.size() != packed_size || type > 1) throw Mdf4Damaged();
  std::string bytes(size, '\0');
  uLongf written = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (status != Z_OK || written != size) throw Mdf4Damaged();
  if (type == 0 || width < 2 || size / width < 2) return bytes;
  // Transposed: first all first bytes of the records, then all second ones; what is no whole record stands as it is.
  const std::uint64_t rows = size / width;
  std::string records = bytes;
  for (std::uint64_t column = 0; column < width; ++column) {
    for (std::uint64_t row = 0; row < rows; ++row) records[row * width + column] = bytes[column * rows + row];
  }
  return records;
}

void append_records(const Mdf4Bytes& file, std::uint64_t at, int depth, std::string& records) {
  constexpr int kDeepest = 3;  // HL, DL, DT
  if (at == 0) return;
  if (depth > kDeepest) throw Mdf4Damaged();
  constexpr int kMostLists = 1'000'000;
  for (int lists = 0; at != 0; ++lists) {
    const Mdf4Block block(file, at, {"DT", "DV", "DZ", "DL", "HL"});
    if (lists > kMostLists) throw Mdf4Damaged();
    if (block.name() == "DT" || block.name() == "DV") records += block.rest();
    if (block.name() == "DZ") records += inflate_block(block);
    if (block.name() == "HL") append_records(file, block.link(0), depth + 1, records);
    if (block.name() != "DL") return;
    for (std::uint64_t i = 1; i < block.link_count(); ++i) append_records(file, block.link(i), depth + 2, records);
    at = block.link(0);
  }
}

}  // namespace

const char* Mdf4Bytes::place(std::uint64_t at, std::uint64_t size) const {
  if (at > bytes_.size() || size > bytes_.size() - at) throw Mdf4Damaged();
  return bytes_.data() + at;
}

template <class T>
T Mdf4Bytes::get(std::uint64_t at) const {
  T value;
  std::memcpy(&value, place(at, sizeof value), sizeof value);
  return value;
}
template std::uint8_t Mdf4Bytes::get(std::uint64_t) const;
template std::uint16_t Mdf4Bytes::get(std::uint64_t) const;
template std::uint32_t Mdf4Bytes::get(std::uint64_t) const;
template std::uint64_t Mdf4Bytes::get(std::uint64_t) const;
template double Mdf4Bytes::get(std::uint64_t) const;

std::string Mdf4Bytes::text(std::uint64_t at, std::uint64_t size) const { return {place(at, size), size}; }

Mdf4Block::Mdf4Block(const Mdf4Bytes& file, std::uint64_t at, const std::vector<std::string>& names)
    : file_(file), at_(at) {
  constexpr std::uint64_t kHeader = 24;
  name_ = file.text(at, 4);
  if (name_.substr(0, 2) != "##") throw Mdf4Damaged();
  name_.erase(0, 2);
  if (std::find(names.begin(), names.end(), name_) == names.end()) throw Mdf4Damaged();
  size_ = file.get<std::uint64_t>(at + 8);
  links_ = file.get<std::uint64_t>(at + 16);
  if (size_ < kHeader || links_ > (size_ - kHeader) / 8) throw Mdf4Damaged();
  file.text(at, size_);  // it is all there
  data_ = at + kHeader + 8 * links_;
}

std::uint64_t Mdf4Block::link(std::uint64_t index) const {
  return index < links_ ? file_.get<std::uint64_t>(at_ + 24 + 8 * index) : 0;
}

std::string Mdf4Block::rest(std::uint64_t at) const {
  const std::uint64_t start = data_ + at;
  if (start > at_ + size_) throw Mdf4Damaged();
  return file_.text(start, at_ + size_ - start);
}

std::string read_mdf4_text(const Mdf4Bytes& file, std::uint64_t at) {
  if (at == 0) return "";
  const Mdf4Block block(file, at, {"TX", "MD"});
  std::string text = block.rest();
  text.erase(std::min(text.find('\0'), text.size()));
  if (block.name() == "TX") return text;
  const std::size_t start = text.find("<TX>");
  const std::size_t end = text.find("</TX>");
  return start == std::string::npos || end == std::string::npos || end < start + 4
             ? ""
             : text.substr(start + 4, end - start - 4);
}

std::string read_mdf4_records(const Mdf4Bytes& file, std::uint64_t at) {
  std::string records;
  append_records(file, at, 0, records);
  return records;
}

}  // namespace rollrig::tables
