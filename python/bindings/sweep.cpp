#include "bindings.h"

namespace rollrig::python {

void bind_sweep(py::module_&) {}

}  // namespace rollrig::python
