#pragma once
/// A quantity that is recorded, given or measured: SI inside, its unit only where it is written to a file.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/units.h"

namespace rollrig {

/// Name and file unit. Two quantities are the same when both are. It holds no text of its own: constants refer
/// to literals, and intern_quantity() keeps the text of names that are made up at run time.
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr Quantity(std::string_view name, std::string_view unit) : name_(name), unit_(unit) {}

  /// Without a unit: "drum_torque".
  constexpr std::string_view name() const { return name_; }
  /// Suffix by which files say the unit: "Nm"; empty for a ratio.
  constexpr std::string_view unit_suffix() const { return unit_; }
  /// The heading of its column in a file: "drum_torque_Nm".
  std::string header() const;
  /// Of its values in files.
  Unit file_unit() const { return unit_of_key(header()); }

  constexpr bool operator==(const Quantity& other) const { return name_ == other.name_ && unit_ == other.unit_; }
  constexpr bool operator!=(const Quantity& other) const { return !(*this == other); }
  constexpr bool operator<(const Quantity& other) const {
    const int order = name_.compare(other.name_);
    return order != 0 ? order < 0 : unit_ < other.unit_;
  }

 private:
  std::string_view name_;
  std::string_view unit_;
};

/// The quantity that a heading names: "drum_torque_Nm" -> drum_torque in Nm. Its text is kept until the program ends.
Quantity intern_quantity(const std::string& header);

/// The headings of columns in a file, after those of `first`.
std::vector<std::string> list_headers(const std::vector<Quantity>& quantities, std::vector<std::string> first = {});

/// A map by quantity. The heading that a file has for it finds the same entry; one in another unit does not.
template <class T>
class QuantityMap : public std::map<Quantity, T> {
 public:
  using Map = std::map<Quantity, T>;
  using Map::Map, Map::at, Map::count, Map::operator[];
  T& at(const std::string& header) { return at(intern_quantity(header)); }
  const T& at(const std::string& header) const { return at(intern_quantity(header)); }
  std::size_t count(const std::string& header) const { return count(intern_quantity(header)); }
  T& operator[](const std::string& header) { return (*this)[intern_quantity(header)]; }
};

}  // namespace rollrig
