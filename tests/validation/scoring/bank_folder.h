#pragma once
/// Banks on disk whose sets are no sets: a diagnosis of them fails at once.

#include <filesystem>

#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/temporary_folder.h"
#include "validation/scoring/bank.h"

namespace rollrig::tests {

/// Sets 0001 to 0003 with no effect, rim_heat and one outside of the catalog, and their sealed truth.
struct BankFolder {
  TemporaryFolder folder;
  std::string bank = folder.file("bank");
  std::string truth = bank + "/truth.json";
  std::string seal;

  BankFolder() {
    Json json = {{"format", "rollrig-blind-bank/1"}, {"sets", Json::object()}};
    const char* effects[] = {nullptr, "rim_heat", "drafting"};
    for (int i = 0; i < 3; ++i) {
      const std::string set = "000" + std::to_string(i + 1);
      std::filesystem::create_directories(bank + "/sets/" + set);
      write_file(bank + "/sets/" + set + "/set.toml", "no set " + set + "\n");
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
    seal = calc_sha256(text);
    write_file(bank + "/seal.sha256", seal + "  truth.json\n");
  }
  std::string answer(const std::string& set) const { return bank + "/answers/" + set + ".json"; }
};

}  // namespace rollrig::tests
