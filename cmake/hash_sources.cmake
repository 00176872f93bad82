# Writes OUTPUT, a source file that defines rollrig::library_sources(): the beginning of the SHA-256 over the names and
# contents of the sources in FOLDERS of ROOT.
# cmake -DROOT=... -DFOLDERS="sim;models" -DOUTPUT=... -P hash_sources.cmake
set(patterns)
foreach(folder IN LISTS FOLDERS)
  list(APPEND patterns "${ROOT}/${folder}/*.cpp" "${ROOT}/${folder}/*.h")
endforeach()
file(GLOB_RECURSE sources RELATIVE "${ROOT}" ${patterns})
list(SORT sources)
set(hashes)
foreach(source IN LISTS sources)
  file(SHA256 "${ROOT}/${source}" hash)
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING "${hash}" 0 16 beginning)
file(WRITE "${OUTPUT}" "// Made by cmake/hash_sources.cmake.
#include \"rollrig/version.h\"

namespace rollrig {

const char* library_sources() { return \"${beginning}\"; }

}  // namespace rollrig
")
