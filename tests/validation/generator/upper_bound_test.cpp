// rollrig_validation upper-bound on validation sets of a few short cases.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

void hash_truth(const std::string& root) {
  write_file(root + "/truth.sha256", calc_sha256(read_file(root + "/truth.json")) + "  truth.json\n");
}

/// A validation set of cases made with these options of `rollrig_validation make-case`.
void make_set(const std::string& root, const std::vector<std::string>& orders) {
  Json truth{{"format", "rollrig-blind-bank/1"}, {"sets", Json::object()}};
  fs::create_directories(root + "/sets");
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const std::string number = fmt::format("{:04}", i + 1);
    const auto made =
        run_validation(fmt::format("make-case {} --out {}/sets/{} --truth {}/one.json", orders[i], root, number, root));
    INFO(made.err);
    REQUIRE(made.status == 0);
    truth["sets"][number] = Json::parse(read_file(root + "/one.json"));
  }
  write_file(root + "/truth.json", truth.dump(1) + "\n");
  hash_truth(root);
}

Json find_upper_bound(const std::vector<std::string>& orders, const std::string& options = "") {
  const TemporaryFolder folder;
  make_set(folder.file("set"), orders);
  const auto ran = run_validation(fmt::format("upper-bound {} {}", folder.file("set"), options));
  INFO(ran.err);
  REQUIRE(ran.status == 0);
  return Json::parse(read_file(folder.file("set/upper_bound.json"))).at("sets");
}

bool has_twin(const Json& set, const std::string& id) {
  const auto twins = set.at("twins").get<std::vector<std::string>>();
  return std::find(twins.begin(), twins.end(), id) != twins.end();
}

}  // namespace

TEST_CASE("d' grows in proportion to a small size", "[slow]") {
  const std::string drum = "--kind drum --runs 2 --seed 4 --effect ";
  const Json sets = find_upper_bound(
      {drum + "torque_zero_drift --form amplifier --size 0.2", drum + "torque_zero_drift --form amplifier --size 0.4",
       drum + "rim_heat --form one_node --size 0.05", drum + "rim_heat --form one_node --size 0.1"});
  const auto d_prime = [&sets](const char* set) { return sets.at(set).at("d_prime").get<double>(); };
  CHECK(d_prime("0001") > 0.5);
  CHECK(d_prime("0002") == Approx(2.0 * d_prime("0001")).epsilon(0.002));
  CHECK(d_prime("0003") > 0.5);
  CHECK(d_prime("0004") == Approx(2.0 * d_prime("0003")).epsilon(0.05));
}

TEST_CASE("an effect is compared with all others, a pair also with its members, one from outside with none", "[slow]") {
  const std::string drum = "--kind drum --runs 2 --seed 4 --effect ";
  const Json sets = find_upper_bound(
      {drum + "rim_heat", drum + "none", drum + "rim_heat,torque_zero_drift", drum + "heater_radiation"});
  CHECK(sets.size() == 3);
  const Json& single = sets.at("0001");
  CHECK(single.at("log_bayes_factors").count("rim_heat") == 0);
  CHECK(single.at("log_bayes_factors").count("torque_zero_drift") == 1);
  CHECK(single.at("log_bayes_factors").count("slip_loss") == 0);  // not on a drum
  const Json& pair = sets.at("0003");
  CHECK(pair.at("log_bayes_factors").count("rim_heat") == 1);
  CHECK(pair.at("log_bayes_factors").count("torque_zero_drift") == 1);
  const Json& outside = sets.at("0004");
  CHECK(outside.at("d_prime") > 0.0);
  CHECK(outside.count("identifiable") == 0);
}

TEST_CASE("under one load straps, load record and curvature scale the loss alike, and a clock that is late does not",
          "[slow]") {
  const std::string dyno = "--kind dyno --runs 1 --seed 4 --effect ";
  const Json sets = find_upper_bound(
      {dyno + "tie_down_load --form relaxing --size 600", dyno + "curvature_exponent --form power --size 3"});
  for (const char* set : {"0001", "0002"}) {
    INFO(sets.at(set).dump(1));
    CHECK(sets.at(set).at("d_prime") > 3.0);
    CHECK_FALSE(sets.at(set).at("identifiable").get<bool>());
    CHECK(has_twin(sets.at(set), "load_record"));
    CHECK_FALSE(has_twin(sets.at(set), "clock_shift"));
  }
  CHECK(has_twin(sets.at("0001"), "curvature_exponent"));
}

TEST_CASE("the upper bound does not depend on threads, nor a case's on the other cases", "[slow]") {
  const std::vector<std::string> orders{"--kind road --runs 1 --effect speed_record --seed 1",
                                        "--kind drum --runs 1 --effect windage --seed 2",
                                        "--kind drum --runs 1 --effect slow_leak --seed 3"};
  const Json all = find_upper_bound(orders, "--threads 1");
  CHECK(find_upper_bound(orders, "--threads 3") == all);
  const Json one = find_upper_bound(orders, "--cases 0002");
  CHECK(one.size() == 1);
  CHECK(one.at("0002") == all.at("0002"));
}

TEST_CASE("what is detected can be asked for alone, and what can be told apart of some cases after it", "[slow]") {
  const TemporaryFolder folder;
  const std::string root = folder.file("set");
  make_set(root,
           {"--kind drum --runs 1 --effect windage --seed 2", "--kind drum --runs 1 --effect slow_leak --seed 3"});
  const auto bound = [&root](const std::string& options) {
    const auto ran = run_validation("upper-bound " + root + " " + options);
    INFO(ran.err);
    REQUIRE(ran.status == 0);
    return Json::parse(read_file(root + "/upper_bound.json")).at("sets");
  };
  const Json detected = bound("--detection");
  REQUIRE(detected.size() == 2);
  for (const Json& set : detected) CHECK(set.count("identifiable") == 0);
  const Json both = bound("--cases 0002");
  CHECK(both.at("0001") == detected.at("0001"));
  CHECK(both.at("0002").at("d_prime") == detected.at("0002").at("d_prime"));
  CHECK(both.at("0002").count("identifiable") == 1);
  // of another truth nothing is kept
  std::string other = read_file(root + "/upper_bound.json");
  const std::size_t at = other.find("truth_sha256") + 16;
  other[at] = other[at] == '0' ? '1' : '0';
  write_file(root + "/upper_bound.json", other);
  CHECK(bound("--cases 0002").size() == 1);
}

TEST_CASE("a truth of another hash, other files and a wrong place are refused, and nothing is written", "[fast]") {
  const TemporaryFolder folder;
  const std::string root = folder.file("set");
  make_set(root, {"--kind drum --runs 1 --effect windage --seed 2"});
  const auto refuse = [&root](const std::string& options, const std::string& why) {
    const auto ran = run_validation("upper-bound " + root + " " + options);
    INFO(options);
    CHECK(ran.status == 2);
    CHECK_THAT(ran.err, Catch::Contains(why));
    CHECK_FALSE(fs::exists(root + "/upper_bound.json"));
  };
  refuse("--out " + root + "/truth.json", "validation set's own files");
  refuse("--out " + root + "/sets/0001/upper_bound.json", "validation set's own files");
  refuse("--cases 0010", "0001");
  const std::string truth = read_file(root + "/truth.json");
  write_file(root + "/truth.json", truth + "\n");
  refuse("", "another hash");
  hash_truth(root);
  const std::string tire = read_file(root + "/sets/0001/tire.toml");
  write_file(root + "/sets/0001/tire.toml", tire + "\n");
  refuse("", "tire.toml");
  write_file(root + "/truth.json", "{}");
  hash_truth(root);
  refuse("", "not the truth of a validation set");
  fs::remove(root + "/truth.sha256");
  refuse("", "truth.sha256");
}
