// Includes follow one direction: cli -> api -> report -> diagnosis -> scenarios -> estimation -> measurements -> rigs
// -> models -> sim/core, report -> comparison -> diagnosis, rigs -> sim -> sim/core, and api -> campaigns -> sim/core.
// Validation stands on top of all of it, its generator on sim/core alone. Third-party packages stay behind a few files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "build_paths.h"

namespace fs = std::filesystem;

namespace {

const fs::path kSource = ROLLRIG_SOURCE_DIR;

/// The folders from the lowest up; each may include what stands before it.
const std::vector<std::string> kOrder{"include/rollrig",
                                      "sim/core",
                                      "tables",
                                      "sim",
                                      "models",
                                      "rigs",
                                      "rigs/multibody",
                                      "fmu",
                                      "measurements",
                                      "estimation",
                                      "scenarios",
                                      "exports",
                                      "diagnosis",
                                      "comparison",
                                      "report",
                                      "campaigns",
                                      "api",
                                      "serve",
                                      "cli",
                                      "cli/mpi",
                                      "cli/serve",
                                      "validation",
                                      "validation/generator",
                                      "validation/scoring",
                                      "validation/program",
                                      "examples",
                                      "python"};

/// Includes of lower folders that are wrong nevertheless.
const std::set<std::pair<std::string, std::string>> kForbidden{{"models", "sim"},
                                                               {"diagnosis", "exports"},
                                                               {"campaigns", "report"},
                                                               {"report", "exports"},
                                                               {"validation/scoring", "exports"},
                                                               {"validation/scoring", "report"},
                                                               {"validation/scoring", "cli"},
                                                               {"validation/scoring", "validation/generator"}};

/// Of the project the command line may include these.
const std::set<std::string> kOfCommandLine{"include/rollrig", "cli", "sim/core"};

/// Of the project the generator, which the diagnosis is judged by, may include this alone.
const std::set<std::string> kOfGenerator{"sim/core", "validation", "validation/generator"};

/// Files that may include a package's headers; a folder's name stands for all its files.
const std::map<std::string, std::set<std::string>> kPackages{
    {"cvodes/|nvector/|sunmatrix/|sunlinsol/", {"sim/cvodes_integrator.cpp"}},
    {"toml\\+\\+/", {"sim/core/config.cpp"}},
    {"Simbody.h", {"rigs/multibody"}},
    {"CLI/", {"cli", "cli/serve", "validation/program"}},
    {"httplib.h", {"serve/http.h"}},
    {"nlohmann/", {"sim/core/json.h"}},
    {"ceres/", {"sim/core/scalar.h", "estimation/least_squares/library.cpp"}},
    {"glog/", {"estimation/least_squares/library.cpp"}},
    {"dlfcn.h", {"sim/core/shared_library.cpp"}},
    {"edlib.h", {"sim/core/nearest_name.cpp"}},
    {"udunits2.h", {"sim/core/unit_names.cpp"}},
    {"SQLiteCpp/|sqlite3.h", {"campaigns/store.cpp"}},
    {"tbb/", {"sim/core/parallel.cpp"}},
    {"sha256.h", {"sim/core/file_io.cpp"}},
    {"boost/numeric/odeint", {"validation/generator/recorder.cpp"}},
    {"mpi.h", {"campaigns/mpi/hand_out.cpp", "campaigns/mpi/ranks.cpp"}},
    {"hdf5.h", {"tables/hdf5_handle.h"}},
    {"libxml/", {"exports/xml.h"}},
    {"minizip/", {"exports/zip_archive.cpp"}},
    {"zlib.h", {"tables/mdf4_blocks.cpp"}},
    {"pybind11/", {"python"}},
    {"matio.h", {"exports/mat_file.cpp", "tables/mat_table.cpp"}},
};

std::string folder_of(const std::string& path) {
  if (path.rfind("rollrig/", 0) == 0) return "include/rollrig";
  for (const char* inner : {"include/rollrig", "sim/core", "rigs/multibody", "cli/mpi", "cli/serve",
                            "validation/generator", "validation/scoring", "validation/program"}) {
    if (path.rfind(inner + std::string("/"), 0) == 0) return inner;
  }
  return path.substr(0, path.find('/'));
}

/// Place in the order; past its end for what is not in it.
std::size_t rank_of(const std::string& folder) {
  return static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), folder) - kOrder.begin());
}

const std::vector<const char*> kTops{"include",   "sim",          "tables",     "models",    "rigs",
                                     "fmu",       "measurements", "estimation", "scenarios", "exports",
                                     "diagnosis", "comparison",   "validation", "report",    "campaigns",
                                     "api",       "serve",        "cli",        "examples",  "python"};

template <class Visit>
void visit_includes(Visit&& visit) {
  const std::regex include("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"]");
  for (const char* top : kTops) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      const std::string file = fs::relative(entry.path(), kSource).string();
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (std::regex_search(line, match, include)) visit(file, match[1].str());
      }
    }
  }
}

}  // namespace

TEST_CASE("folders include in one direction only", "[fast]") {
  int checked = 0;
  visit_includes([&](const std::string& file, const std::string& included) {
    const std::string from = folder_of(file);
    const std::string to = folder_of(included);
    if (rank_of(to) == kOrder.size()) return;  // a package, the standard library
    INFO(file << " includes " << included);
    CHECK(rank_of(to) <= rank_of(from));
    CHECK(kForbidden.count({from, to}) == 0);
    ++checked;
  });
  CHECK(checked > 100);  // the test looks at something
}

TEST_CASE("the independent generator includes nothing of the simulator", "[fast]") {
  int own = 0;
  visit_includes([&](const std::string& file, const std::string& included) {
    if (folder_of(file) != "validation/generator" || !fs::exists(kSource / included)) return;
    INFO(file << " includes " << included);
    CHECK(kOfGenerator.count(folder_of(included)) == 1);
    ++own;
  });
  CHECK(own > 20);
}

TEST_CASE("the command line, the examples and the Python package use the API alone", "[fast]") {
  int own = 0;
  visit_includes([&](const std::string& file, const std::string& included) {
    const std::string from = folder_of(file);
    const std::string to = folder_of(included);
    if ((from != "cli" && from != "examples" && from != "python") || rank_of(to) == kOrder.size()) return;
    INFO(file << " includes " << included);
    CHECK((to == "include/rollrig" || (from == "cli" && kOfCommandLine.count(to) == 1)));
    ++own;
  });
  CHECK(own > 50);
}

TEST_CASE("tests and documents that the code names are there", "[fast]") {
  const std::regex named("tests/[a-z_0-9/]+\\.cpp|\\b[a-z_0-9]+\\.md");
  int checked = 0;
  for (const char* top : kTops) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        for (std::sregex_iterator at(line.begin(), line.end(), named), end; at != end; ++at) {
          INFO(entry.path() << ": " << at->str());
          CHECK((fs::exists(kSource / at->str()) || fs::exists(kSource / "docs" / at->str())));
          ++checked;
        }
      }
    }
  }
  CHECK(checked > 100);
}

TEST_CASE("a heading of a doc comment begins its line", "[fast]") {
  const std::regex broken(R"(^ *///.*[^ ] (Equation|Symbols|Validity|Source|Errors|Accuracy|Energy|Checked)  +\S)");
  int comments = 0;
  for (const char* top : kTops) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        if (line.find("///") == std::string::npos) continue;
        INFO(entry.path() << ": " << line);
        CHECK_FALSE(std::regex_search(line, broken));
        ++comments;
      }
    }
  }
  CHECK(comments > 1000);
}

TEST_CASE("each package stays behind one or two files", "[fast]") {
  std::map<std::string, int> seen;
  visit_includes([&](const std::string& file, const std::string& included) {
    for (const auto& [package, allowed] : kPackages) {
      if (!std::regex_search(included, std::regex("^(" + package + ")"))) continue;
      INFO(file << " includes " << included);
      CHECK((allowed.count(file) == 1 || allowed.count(folder_of(file)) == 1));
      ++seen[package];
    }
  });
  CHECK(seen.size() == kPackages.size());
}
