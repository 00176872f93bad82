#include "sim/core/quantity.h"

#include <map>
#include <mutex>

namespace rollrig {

std::string Quantity::header() const {
  std::string text(name_);
  if (!unit_.empty()) text.append("_").append(unit_);
  return text;
}

Quantity intern_quantity(const std::string& header) {
  static std::mutex mutex;
  static std::map<std::string, std::size_t> name_lengths;  // by header; nodes stay where they are
  const std::lock_guard<std::mutex> lock(mutex);
  auto known = name_lengths.find(header);
  if (known == name_lengths.end()) known = name_lengths.emplace(header, name_without_unit(header).size()).first;
  const std::string_view text = known->first;
  const std::size_t length = known->second;
  if (length == text.size()) return {text, {}};
  return {text.substr(0, length), text.substr(length + 1)};
}

std::vector<std::string> list_headers(const std::vector<Quantity>& quantities, std::vector<std::string> first) {
  for (const Quantity& quantity : quantities) first.push_back(quantity.header());
  return first;
}

}  // namespace rollrig
