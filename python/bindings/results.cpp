#include "bindings.h"

namespace rollrig::python {

void bind_results(py::module_&) {}

}  // namespace rollrig::python
