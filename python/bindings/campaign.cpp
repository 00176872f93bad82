#include "bindings.h"

namespace rollrig::python {

void bind_campaign(py::module_&) {}

}  // namespace rollrig::python
