#include "rollrig/result.h"

#include "api/data.h"
#include "report/blocks.h"
#include "rollrig/version.h"
#include "sim/core/file_io.h"

namespace rollrig {

const char* library_version() { return ROLLRIG_VERSION; }

Channel make_channel(const Quantity& quantity, std::vector<double> values_SI) {
  return {quantity.header(), quantity.file_unit().symbol, report::in_unit_of(quantity.header(), std::move(values_SI))};
}

void write_folder(const std::string& folder, const FolderFiles& files, bool force) {
  OutputFolder out(folder, force);
  for (const auto& [name, content] : files) out.add(name, content);
  out.commit();
}

}  // namespace rollrig
