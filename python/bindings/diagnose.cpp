#include "bindings.h"

namespace rollrig::python {

void bind_diagnose(py::module_&) {}

}  // namespace rollrig::python
