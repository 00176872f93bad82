#pragma once
/// Versions of the library are major.minor.patch; what stays is said in docs/api.md.

#pragma GCC visibility push(default)
namespace rollrig {

/// Of these headers.
constexpr const char* kVersion = "0.1.0";
/// Of the library that the program has loaded.
const char* library_version();
/// Of its sources: the first 16 digits of the SHA-256 over those on which results depend. Two builds of one version with
/// the same sources have the same.
const char* library_sources();

}  // namespace rollrig
#pragma GCC visibility pop
