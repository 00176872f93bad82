#include "bindings.h"

namespace rollrig::python {

void bind_assets(py::module_&) {}

}  // namespace rollrig::python
