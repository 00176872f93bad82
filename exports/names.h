#pragma once
/// Names that a file's format allows, each once in its group.

#include <set>
#include <string>

namespace rollrig::exports {

class Names {
 public:
  /// `name`, or where it is taken already the first free of name_2, name_3, ...
  std::string make_unique(const std::string& name) {
    std::string unique = name;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    return unique;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace rollrig::exports
