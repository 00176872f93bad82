#include <exception>
#include <iostream>

#include "sim/core/file_io.h"
#include "tools/published_tables.h"

/// usage: published_tables <file.md>
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: published_tables <file.md>\n";
    return 2;
  }
  try {
    rollrig::write_output(argv[1], rollrig::tools::make_published_page());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
