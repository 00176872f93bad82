/// Writes docs/ex30.md. usage: ex30_page <phases.csv> <page.md>
#include <exception>
#include <iostream>

#include "sim/core/file_io.h"
#include "tools/multi_cycle.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: ex30_page <phases.csv> <page.md>\n";
    return 2;
  }
  try {
    rollrig::write_output(argv[2], rollrig::tools::make_ex30_page(argv[1]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
