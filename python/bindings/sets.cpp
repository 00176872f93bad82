#include "bindings.h"

namespace rollrig::python {

void bind_sets(py::module_&) {}

}  // namespace rollrig::python
