#include "rollrig/version.h"

namespace rollrig {

const char* library_version() { return ROLLRIG_VERSION; }

}  // namespace rollrig
