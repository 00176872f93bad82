// rollrig_validation baselines as users meet it.
#include <catch2/catch.hpp>

#include "tests/support/run_program.h"
#include "tests/validation/scoring/validation_set_folder.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig::tests;

TEST_CASE("baselines answers by each method, blind to the truth, and goes on from what is there", "[slow]") {
  const ValidationSetFolder made;
  fs::remove(made.truth);
  const auto first = run_validation("baselines set --methods bic,gp", made.folder.path());
  INFO(first.err);
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("answers-bic/: 3 now") && Contains("answers-gp/: 3 now"));
  fs::remove(made.root + "/answers-gp/0002.json");
  const auto all = run_validation("baselines set", made.folder.path());
  CHECK_THAT(all.out, Contains("answers-nearest/: 3 now") && Contains("answers-gp/: 1 now, 2 before"));
}

TEST_CASE("a method, an effect or a validation set that there is not ends with status 2", "[fast]") {
  const ValidationSetFolder made;
  CHECK(run_validation("baselines set --methods kriging", made.folder.path()).status == 2);
  CHECK(run_validation("baselines set --only rim_heet", made.folder.path()).status == 2);
  CHECK(run_validation("baselines no_bank", made.folder.path()).status == 2);
  CHECK_FALSE(fs::exists(made.root + "/answers-nearest"));
}

TEST_CASE("a score fills the column of the best baseline where folders of baselines are there", "[slow]") {
  const ValidationSetFolder made;
  REQUIRE(run_validation("run set --quiet", made.folder.path()).status == 0);
  REQUIRE(run_validation("baselines set --quiet --methods aic,sparse", made.folder.path()).status == 0);
  const auto score = run_validation("score set --json score.json", made.folder.path());
  INFO(score.err);
  CHECK(score.status == 0);
  CHECK_THAT(score.out, Contains("Baselines") && Contains("LASSO"));
  std::istringstream in(score.out);
  for (std::string line; std::getline(in, line);) CHECK(line.size() <= 80);
  const auto figures = rollrig::Json::parse(read_file(made.folder.file("score.json")))["figures"];
  CHECK(figures[0]["best_baseline_id"] == "aic");
  fs::remove(made.root + "/answers-aic/0001.json");
  const auto lacking = run_validation("score set", made.folder.path());
  CHECK(lacking.status == 2);
  CHECK_THAT(lacking.err, Contains("1 of 3 cases") && Contains("rollrig_validation baselines set"));
}
