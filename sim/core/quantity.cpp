#include "sim/core/quantity.h"

#include <mutex>
#include <set>

namespace rollrig {

std::string Quantity::header() const {
  std::string text(name_);
  if (!unit_.empty()) text.append("_").append(unit_);
  return text;
}

Quantity intern_quantity(const std::string& header) {
  static std::mutex mutex;
  static std::set<std::string> texts;  // nodes stay where they are
  const std::lock_guard<std::mutex> lock(mutex);
  const std::string_view text = *texts.insert(header).first;
  const std::size_t length = name_without_unit(header).size();
  if (length == text.size()) return {text, {}};
  return {text.substr(0, length), text.substr(length + 1)};
}

std::vector<std::string> list_headers(const std::vector<Quantity>& quantities, std::vector<std::string> first) {
  for (const Quantity& quantity : quantities) first.push_back(quantity.header());
  return first;
}

}  // namespace rollrig
