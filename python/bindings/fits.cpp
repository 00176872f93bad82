#include "bindings.h"

namespace rollrig::python {

void bind_fits(py::module_&) {}

}  // namespace rollrig::python
