#include "sim/core/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "sim/core/error.h"

namespace rollrig {

void* load_entry(const char* library, const char* entry, const std::string& what, const std::string& otherwise) {
  void* handle = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  void* found = handle == nullptr ? nullptr : ::dlsym(handle, entry);
  if (found == nullptr) {
    const char* reason = ::dlerror();
    throw RunFailure(
        fmt::format("{} cannot be loaded: {}; it is installed with rollrig, beside its other libraries{}{}", what,
                    reason != nullptr ? reason : library, otherwise.empty() ? "" : "; ", otherwise));
  }
  return found;
}

}  // namespace rollrig
