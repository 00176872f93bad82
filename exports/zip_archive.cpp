#include "exports/zip_archive.h"

#include <minizip/zip.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace rollrig::exports {
namespace {

void require_zip(bool is_good) {
  if (!is_good) throw std::runtime_error("a ZIP archive could not be made");
}

/// A file in memory.
struct MemoryFile {
  ~MemoryFile() {
    if (file != nullptr) std::fclose(file);
    std::free(bytes);
  }
  char* bytes = nullptr;
  std::size_t size = 0;
  FILE* file = ::open_memstream(&bytes, &size);
};

/// minizip's functions for files, on that file.
zlib_filefunc64_def make_file_functions(MemoryFile& memory) {
  zlib_filefunc64_def functions;
  fill_fopen64_filefunc(&functions);
  functions.opaque = memory.file;
  functions.zopen64_file = [](void* file, const void*, int) { return file; };
  functions.zclose_file = [](void*, void* file) { return std::fflush(static_cast<FILE*>(file)); };
  return functions;
}

void add_to_zip(zipFile archive, const std::string& path, const std::string& content) {
  zip_fileinfo info{};
  info.dosDate = 0x210000;  // 1980-01-01: the archive does not depend on when it was made
  require_zip(zipOpenNewFileInZip(archive, path.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                  Z_DEFAULT_COMPRESSION) == ZIP_OK);
  require_zip(zipWriteInFileInZip(archive, content.data(), static_cast<unsigned>(content.size())) == ZIP_OK);
  require_zip(zipCloseFileInZip(archive) == ZIP_OK);
}

}  // namespace

std::string make_zip(const std::map<std::string, std::string>& files) {
  MemoryFile memory;
  require_zip(memory.file != nullptr);
  zlib_filefunc64_def functions = make_file_functions(memory);
  const zipFile archive = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  require_zip(archive != nullptr);
  try {
    for (const auto& [path, content] : files) add_to_zip(archive, path, content);
  } catch (...) {
    zipClose(archive, nullptr);
    throw;
  }
  require_zip(zipClose(archive, nullptr) == ZIP_OK);
  return {memory.bytes, memory.size};
}

}  // namespace rollrig::exports
