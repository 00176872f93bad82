#include <exception>
#include <iostream>
#include <string>

#include "sim/core/file_io.h"
#include "tools/physics_page.h"
#include "tools/published_tables.h"
#include "tools/reference_page.h"

/// Writes the generated pages of docs/. usage: write_docs <docs folder>
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_docs <docs folder>\n";
    return 2;
  }
  try {
    const std::string folder = argv[1];
    rollrig::write_output(folder + "/published.md", rollrig::tools::make_published_page());
    rollrig::write_output(folder + "/physics.md", rollrig::tools::make_physics_page(ROLLRIG_SOURCE_DIR));
    rollrig::write_output(folder + "/reference.md", rollrig::tools::make_reference_page());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
