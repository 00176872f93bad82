#pragma once
/// A validation set of one case, and a plan of follow-up runs for it that is made by hand.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "measurements/measurement_set.h"
#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"
#include "validation/files.h"

namespace rollrig::tests {

inline std::map<std::string, std::string> read_folder(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path().string());
  }
  return files;
}

struct PlannedCase {
  TemporaryFolder folder;
  std::string root = folder.file("set");
  std::string plan_folder = root + "/followup/plans/0001";
  Json truth;  // of the case
  Json plan;

  explicit PlannedCase(const std::string& order, const std::string& kind = "drum") {
    std::filesystem::create_directories(root + "/sets");
    const auto made = run_validation(fmt::format("make-case --kind {} {} --out {}/sets/0001 --truth {}", kind, order,
                                                 root, folder.file("one.json")));
    INFO(made.err);
    REQUIRE(made.status == 0);
    truth = Json::parse(read_file(folder.file("one.json")));
    const Json all_truth{{"format", "rollrig-blind-bank/1"}, {"sets", {{"0001", truth}}}};
    write_file(root + "/truth.json", all_truth.dump());
    write_file(root + "/truth.sha256", calc_sha256(all_truth.dump()) + "  truth.json\n");
    plan = {{"format", "rollrig-blind-plan/1"},
            {"kind", kind},
            {"set_sha256", validation::hash_case(validation::case_folder(root, "0001"))}};
    plan["runs"] = Json::array();
  }

  /// Adds a run to the plan and writes all of it.
  void add(const std::string& csv, const Json& unread = Json::array(), bool at_standstill = false) {
    const std::string id = fmt::format("test-{}", plan["runs"].size() + 1);
    plan["runs"].push_back({{"id", id},
                            {"file", id + ".csv"},
                            {"session", "next"},
                            {"cold_pressure_kPa", 240.0},
                            {"force_at_standstill", at_standstill},
                            {"not_read_s", unread}});
    std::filesystem::create_directories(plan_folder);
    write_file(plan_folder + "/" + id + ".csv", csv);
    write_file(plan_folder + "/plan.json", plan.dump());
  }

  ProgramResult run(const std::string& options = "") const { return run_validation("follow-up " + root + options); }

  measurements::MeasurementSet follow() const {
    const ProgramResult ran = run();
    INFO(ran.err);
    REQUIRE(ran.status == 0);
    CHECK_THAT(ran.out, Catch::Contains("1 cases"));
    return measurements::read_measurement_set(root + "/followup/sets/0001");
  }
};

constexpr const char* kDrumHeader = "time_s,speed_km_h,load_N,ambient_degC\n";
inline const std::string kSteady = std::string(kDrumHeader) + "0,80,5000,24\n600,80,5000,24\n";

}  // namespace rollrig::tests
