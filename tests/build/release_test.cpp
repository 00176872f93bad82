// What a release says of itself: one version, one date, and every package with its license.
#include <catch2/catch.hpp>
#include <regex>
#include <sstream>

#include "build_paths.h"
#include "tests/support/temporary_folder.h"

using Catch::Contains;
using rollrig::tests::read_file;

namespace {

std::string read_source(const std::string& name) { return read_file(std::string(ROLLRIG_SOURCE_DIR) + "/" + name); }

std::string find(const std::string& text, const std::string& pattern) {
  std::smatch match;
  INFO(pattern);
  REQUIRE(std::regex_search(text, match, std::regex(pattern)));
  return match[1].str();
}

}  // namespace

TEST_CASE("version and date of the release are the same everywhere", "[fast]") {
  const std::string cmake = read_source("CMakeLists.txt");
  const std::string version = find(cmake, "project\\(rollrig VERSION ([0-9.]+)");
  const std::string date = find(cmake, "ROLLRIG_RELEASE_DATE ([0-9-]+)");
  CHECK_THAT(read_source("CHANGELOG.md"), Contains("## [" + version + "] - " + date + "\n"));
  CHECK_THAT(read_source("include/rollrig/version.h"), Contains("kVersion = \"" + version + "\";"));
  CHECK_THAT(read_source("CITATION.cff"), Contains("\nversion: " + version + "\ndate-released: " + date + "\n"));
}

TEST_CASE("every package has its license in NOTICE.md", "[fast]") {
  const std::string notice = read_source("NOTICE.md");
  std::istringstream packages(read_source("tools/packages.txt") + read_source("tools/packages_unpacked.txt") +
                              read_source("tools/packages_tests.txt") + read_source("tools/packages_docs.txt") +
                              read_source("tools/packages_package.txt"));
  for (std::string package; std::getline(packages, package);) CHECK_THAT(notice, Contains("`" + package + "`"));
}
