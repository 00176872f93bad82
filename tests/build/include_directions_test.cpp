// Includes follow one direction: cli -> report -> proof -> diagnosis, import -> identification -> scenarios -> rigs ->
// models -> sim/core, and rigs, scenarios -> sim -> sim/core. Third-party packages stay behind a few files.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

const fs::path kSource = ROLLRIG_SOURCE_DIR;

/// What each folder may include beside itself.
const std::map<std::string, std::set<std::string>> kAllowed{
    {"sim/core", {}},
    {"sim", {"sim/core"}},
    {"models", {"sim/core"}},
    {"rigs", {"models", "sim", "sim/core"}},
    {"scenarios", {"rigs", "models", "sim", "sim/core"}},
    {"identification", {"scenarios", "rigs", "models", "sim", "sim/core"}},
    {"diagnosis", {"identification", "scenarios", "rigs", "models", "sim", "sim/core"}},
    {"import", {"identification", "scenarios", "rigs", "models", "sim", "sim/core"}},
    {"blind", {}},  // the foreign generator: shares nothing with what it is to judge
    {"proof", {"diagnosis", "identification", "scenarios", "rigs", "models", "sim", "sim/core"}},
    {"report", {"proof", "diagnosis", "identification", "scenarios", "rigs", "models", "sim", "sim/core"}},
    {"export", {"scenarios", "rigs", "models", "sim", "sim/core"}},
    {"cli",
     {"report", "export", "proof", "diagnosis", "import", "identification", "scenarios", "rigs", "models", "sim",
      "sim/core"}},
};

/// Files that may include a package's headers; a folder's name stands for all its files.
const std::map<std::string, std::set<std::string>> kPackages{
    {"cvodes/|nvector/|sunmatrix/|sunlinsol/", {"sim/cvodes_integrator.cpp"}},
    {"toml\\+\\+/", {"sim/core/config.cpp"}},
    {"Simbody.h",
     {"models/contact_force_element.h", "rigs/drum_actuators.h", "rigs/multibody_drum.cpp",
      "rigs/multibody_vehicle.cpp", "rigs/simbody_system.h", "rigs/vehicle_bodies.h", "rigs/vehicle_drive.h"}},
    {"CLI/", {"cli", "blind/main.cpp", "blind/effect_options.cpp"}},
    {"nlohmann/", {"sim/core/json.h", "blind/measurement_set.h"}},
    {"ceres/", {"sim/core/scalar.h", "identification/fit_tire.cpp", "diagnosis/refit.cpp"}},
    {"edlib.h", {"sim/core/error.cpp", "blind/problem.cpp"}},
    {"tbb/", {"sim/core/parallel.cpp"}},
    {"sha256.h", {"sim/core/file_io.cpp", "blind/output.cpp"}},
    {"boost/numeric/odeint", {"blind/recorder.cpp"}},
    {"mpi.h", {"proof/ranks.cpp"}},
    {"hdf5.h", {"export/hdf5_file.cpp"}},
    {"matio.h", {"export/mat_file.cpp"}},
};

std::string folder_of(const std::string& path) {
  if (path.rfind("sim/core/", 0) == 0) return "sim/core";
  return path.substr(0, path.find('/'));
}

template <class Visit>
void visit_includes(Visit&& visit) {
  const std::regex include("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"]");
  for (const char* top : {"sim", "models", "rigs", "scenarios", "identification", "diagnosis", "import", "proof",
                          "report", "export", "blind", "cli"}) {
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
    if (kAllowed.count(to) == 0) return;  // a package or the standard library
    INFO(file << " includes " << included);
    CHECK((from == to || kAllowed.at(from).count(to) == 1));
    ++checked;
  });
  CHECK(checked > 100);  // the test looks at something
}

TEST_CASE("the foreign generator includes nothing of the simulator, nor the simulator of it", "[fast]") {
  int own = 0;
  visit_includes([&](const std::string& file, const std::string& included) {
    const bool in_project = fs::exists(kSource / included);
    const bool is_blind = file.rfind("blind/", 0) == 0;
    if (!in_project) return;
    INFO(file << " includes " << included);
    CHECK(is_blind == (included.rfind("blind/", 0) == 0));
    if (is_blind) ++own;
  });
  CHECK(own > 20);
}

TEST_CASE("tests that doc comments name are there", "[fast]") {
  const std::regex named("tests/[a-z_0-9/]+\\.cpp");
  int checked = 0;
  for (const char* top :
       {"sim", "models", "rigs", "scenarios", "identification", "diagnosis", "import", "proof", "report", "export"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / top)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        for (std::sregex_iterator at(line.begin(), line.end(), named), end; at != end; ++at) {
          INFO(entry.path() << ": " << at->str());
          CHECK(fs::exists(kSource / at->str()));
          ++checked;
        }
      }
    }
  }
  CHECK(checked > 10);
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
