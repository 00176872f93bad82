/// Writes generated pages of docs/. usage: write_docs <page> ...
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "tools/pages.h"

int main(int argc, char** argv) {
  using namespace rollrig::tools;
  const std::map<std::string, std::string (*)()> pages{{"epa_fleet", make_epa_fleet_page},
                                                       {"ex30", make_ex30_page},
                                                       {"independent_validation", make_independent_page},
                                                       {"physics", make_physics_page},
                                                       {"published", make_published_page},
                                                       {"reference", make_reference_page},
                                                       {"source_gap", make_source_gap_page}};
  try {
    for (int i = 1; i < argc; ++i) {
      rollrig::write_output(fmt::format("{}/docs/{}.md", kProjectFolder, argv[i]), pages.at(argv[i])());
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
