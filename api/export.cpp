#include "rollrig/export.h"

#include "exports/tree.h"

namespace rollrig {

Export read_export(const std::string& source, BadRows bad_rows) {
  std::vector<std::string> warnings;
  const auto tree = std::make_shared<const exports::Group>(exports::read_source(source, bad_rows, &warnings));
  return {[tree] { return exports::make_mat(*tree); }, [tree] { return exports::make_hdf5(*tree); }, warnings};
}

}  // namespace rollrig
