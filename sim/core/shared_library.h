#pragma once
/// Libraries of rollrig that are loaded when they are first needed, since to load what they link takes time
/// (docs/architecture.md).

#include <string>

namespace rollrig {

/// Loads a library, which stays loaded until the program ends, and finds its only function. It is looked for where the
/// other shared libraries of this program are.
/// Symbols  library    its file name
///          entry      name of the function
///          what       for the message: "the library of the multibody rigs"
///          otherwise  for the message: what works without it; may be empty
/// Errors   RunFailure: there is no such library, or no such function in it
void* load_entry(const char* library, const char* entry, const std::string& what, const std::string& otherwise);

}  // namespace rollrig
