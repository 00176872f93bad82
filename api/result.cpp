#include "rollrig/result.h"

#include "api/data.h"
#include "rollrig/version.h"
#include "sim/core/file_io.h"
#include "sim/core/units.h"

namespace rollrig {

const char* library_version() { return ROLLRIG_VERSION; }

Channel make_channel(const Quantity& quantity, std::vector<double> values_SI) {
  const Unit unit = quantity.file_unit();
  for (double& value : values_SI) value = unit.from_si(value);
  return {quantity.header(), unit.symbol, std::move(values_SI)};
}

void write_folder(const std::string& folder, const FolderFiles& files, bool force) {
  OutputFolder out(folder, force);
  for (const auto& [name, content] : files) out.add(name, content);
  out.commit();
}

}  // namespace rollrig
