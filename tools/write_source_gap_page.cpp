#include <exception>
#include <iostream>
#include <string>

#include "sim/core/file_io.h"
#include "tools/source_gap.h"

/// Writes docs/source_gap.md. usage: write_source_gap_page <project folder>
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_source_gap_page <project folder>\n";
    return 2;
  }
  try {
    const std::string folder = argv[1];
    rollrig::write_output(folder + "/docs/source_gap.md",
                          rollrig::tools::make_source_gap_page(folder + "/tests/published"));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
