#pragma once
/// Validation sets on disk whose cases are no measurement sets: a diagnosis of them fails at once.

#include <filesystem>

#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/temporary_folder.h"
#include "validation/files.h"

namespace rollrig::tests {

/// Cases 0001 to 0003 with no effect, rim_heat and one outside of the catalog, and their truth.
struct ValidationSetFolder {
  TemporaryFolder folder;
  std::string root = folder.file("set");
  std::string truth = root + "/truth.json";
  std::string hash;  // of the truth

  ValidationSetFolder() {
    Json json = {{"format", "rollrig-blind-bank/1"}, {"sets", Json::object()}};
    const char* effects[] = {nullptr, "rim_heat", "drafting"};
    for (int i = 0; i < 3; ++i) {
      const std::string set = "000" + std::to_string(i + 1);
      std::filesystem::create_directories(root + "/sets/" + set);
      write_file(root + "/sets/" + set + "/set.toml", "no set " + set + "\n");
      Json of = {{"effects", Json::array()}, {"signal_floors", {{"drum_torque_Nm", 4.0}}}};
      if (effects[i] != nullptr) {
        of["effects"].push_back({{"id", effects[i]}, {"size", 2.0}, {"neutral", 0.0}, {"unit", "W/K"}});
      }
      json["sets"][set] = of;
    }
    write_truth(json.dump());
  }

  void write_truth(const std::string& text) {
    write_file(truth, text);
    hash = calc_sha256(text);
    write_file(root + "/truth.sha256", hash + "  truth.json\n");
  }
  std::string answer(const std::string& number) const { return root + "/answers/" + number + ".json"; }
};

}  // namespace rollrig::tests
