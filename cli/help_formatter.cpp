#include "cli/help_formatter.h"

#include <boost/algorithm/string/case_conv.hpp>

namespace rollrig::cli {

std::string describe_value(const CLI::Option& option) {
  const std::string full = option.get_type_name();  // a type, a colon, and what a check says of itself
  const std::size_t colon = full.find(':');
  if (colon == std::string::npos) return full;
  const std::string type = full.substr(0, colon);
  std::string check = full.substr(colon + 1);
  if (check.size() > 2 && check.front() == '{' && check.back() == '}') {
    check = check.substr(1, check.size() - 2);
    std::replace(check.begin(), check.end(), ',', '|');
    return check;
  }
  if (type.empty() || check.rfind(type, 0) == 0) return check;
  return boost::algorithm::to_lower_copy(check) + " " + type;
}

}  // namespace rollrig::cli
