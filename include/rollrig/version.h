#pragma once
/// Versions of the library are major.minor.patch; what stays is said in docs/api.md.

#pragma GCC visibility push(default)
namespace rollrig {

/// Of these headers.
constexpr const char* kVersion = "0.1.0";
/// Of the library that the program has loaded.
const char* library_version();

}  // namespace rollrig
#pragma GCC visibility pop
