#include "bindings.h"

namespace rollrig::python {

void bind_new(py::module_&) {}

}  // namespace rollrig::python
