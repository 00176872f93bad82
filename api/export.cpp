#include "rollrig/export.h"

#include "exports/tree.h"

namespace rollrig {

Export read_export(const std::string& source) {
  const auto tree = std::make_shared<const exports::Group>(exports::read_source(source));
  return {[tree] { return exports::make_mat(*tree); }, [tree] { return exports::make_hdf5(*tree); }};
}

}  // namespace rollrig
