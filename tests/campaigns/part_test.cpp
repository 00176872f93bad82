// Shares: all items once, whatever starts the processes.
#include "campaigns/part.h"

#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "include/rollrig/error.h"

namespace {

using rollrig::campaigns::find_part;
using rollrig::campaigns::Part;
using rollrig::campaigns::read_part;

using Variables = std::map<std::string, std::string>;

std::optional<Part> find_in(const Variables& variables) {
  return find_part([&variables](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

/// Whether the parts have each item once, and as many as they say.
void require_partition(const std::vector<Part>& parts) {
  constexpr std::size_t kItems = 101;
  std::vector<int> taken(kItems);
  for (const Part& part : parts) {
    std::size_t count = 0;
    for (std::size_t item = 0; item < kItems; ++item) {
      if (!part.has(item)) continue;
      ++taken[item];
      ++count;
    }
    CHECK(part.count_of(kItems) == count);
  }
  CHECK(taken == std::vector<int>(kItems, 1));
}

}  // namespace

TEST_CASE("a part is I of N", "[fast]") {
  CHECK(read_part("3/10").number == 3);
  CHECK(read_part("3/10").count == 10);
  for (const char* text : {"", "3", "0/3", "4/3", "1/0", "a/b", "1.5/3", "1/", "/2", "1/2/3", "-1/3", "1/1e99", "1.0/2",
                           "1e0/2", "+1/2", " 1/2"}) {
    CHECK_THROWS_AS(read_part(text), rollrig::InputError);
  }
}

TEST_CASE("a process that was started by itself has no part", "[fast]") {
  CHECK(!find_in({}).has_value());
  CHECK(!find_in({{"SGE_TASK_ID", "undefined"}}).has_value());
  // The script of a job for several tasks, before srun.
  CHECK(!find_in({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "4"}}).has_value());
}

TEST_CASE("a process may use MPI where a launcher of MPI has started it", "[fast]") {
  const auto is_mpi = [](const Variables& variables) {
    return rollrig::campaigns::is_started_for_mpi([&variables](const char* name) -> const char* {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
  };
  CHECK(is_mpi({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}}));
  CHECK(is_mpi({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}));
  CHECK(!is_mpi({}));
  CHECK(!is_mpi({{"SLURM_PROCID", "0"}, {"SLURM_STEP_NUM_TASKS", "2"}}));
  // srun --mpi=pmix says how many processes there are in its own variable alone.
  const Variables pmix{{"PMIX_RANK", "1"}, {"SLURM_PROCID", "1"}, {"SLURM_STEP_NUM_TASKS", "2"}};
  CHECK(is_mpi(pmix));
  REQUIRE(find_in(pmix).has_value());
  CHECK(find_in(pmix)->number == 2);
  CHECK(find_in(pmix)->count == 2);
}

TEST_CASE("a process that is told its number alone is refused, and the message says how to share", "[fast]") {
  for (const char* name :
       {"PBS_ARRAY_INDEX", "PBS_ARRAYID", "LSB_JOBINDEX", "JOB_COMPLETION_INDEX", "PMIX_RANK", "PALS_RANKID"}) {
    INFO(name);
    CHECK_THROWS_WITH(find_in({{name, "3"}}),
                      Catch::Contains("--shard I/N") && Catch::Contains(std::string("which $") + name));
  }
  CHECK(!find_in({{"LSB_JOBINDEX", "0"}}).has_value());  // a job of LSF that is no array
  // Each task of the array would divide all items among its processes, as the others do.
  CHECK_THROWS_AS(find_in({{"PBS_ARRAY_INDEX", "3"}, {"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}), rollrig::InputError);
  CHECK(find_in({{"FLUX_TASK_RANK", "3"}, {"FLUX_JOB_SIZE", "8"}})->number == 4);
}

TEST_CASE("a task of a job array of any batch system is known as one", "[fast]") {
  const auto is_task = [](const Variables& variables) {
    return rollrig::campaigns::is_array_task([&variables](const char* name) -> const char* {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
  };
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "SGE_TASK_ID", "PBS_ARRAY_INDEX", "LSB_JOBINDEX", "OAR_ARRAY_INDEX",
                           "AWS_BATCH_JOB_ARRAY_INDEX"}) {
    INFO(name);
    CHECK(is_task({{name, "3"}}));
    CHECK(!is_task({{name, ""}}));
  }
  CHECK(is_task({{"JOB_COMPLETION_INDEX", "0"}}));
  CHECK(!is_task({{"SGE_TASK_ID", "undefined"}}));
  CHECK(!is_task({{"LSB_JOBINDEX", "0"}}));
  CHECK(!is_task({}));
}

TEST_CASE("the tasks of a job array have all items once", "[fast]") {
  std::vector<Part> slurm;
  for (const char* id : {"5", "8", "11", "14"}) {
    slurm.push_back(*find_in({{"SLURM_ARRAY_TASK_ID", id},
                              {"SLURM_ARRAY_TASK_MIN", "5"},
                              {"SLURM_ARRAY_TASK_MAX", "14"},
                              {"SLURM_ARRAY_TASK_STEP", "3"}}));
  }
  require_partition(slurm);
  std::vector<Part> grid_engine;
  for (const char* id : {"1", "2", "3"}) {
    grid_engine.push_back(
        *find_in({{"SGE_TASK_ID", id}, {"SGE_TASK_FIRST", "1"}, {"SGE_TASK_LAST", "3"}, {"SGE_TASK_STEPSIZE", "1"}}));
  }
  require_partition(grid_engine);
}

TEST_CASE("processes of one launcher have all items once, and those of a job array, too", "[fast]") {
  std::vector<Part> mpi;
  std::vector<Part> both;
  for (int rank = 0; rank < 3; ++rank) {
    mpi.push_back(*find_in({{"OMPI_COMM_WORLD_RANK", std::to_string(rank)}, {"OMPI_COMM_WORLD_SIZE", "3"}}));
    for (const char* id : {"0", "1"}) {
      both.push_back(*find_in({{"SLURM_ARRAY_TASK_ID", id},
                               {"SLURM_ARRAY_TASK_MIN", "0"},
                               {"SLURM_ARRAY_TASK_MAX", "1"},
                               {"SLURM_PROCID", std::to_string(rank)},
                               {"SLURM_STEP_NUM_TASKS", "3"}}));
    }
  }
  require_partition(mpi);
  require_partition(both);
}

TEST_CASE("what a batch system cannot mean is refused", "[fast]") {
  CHECK_THROWS_AS(find_in({{"SLURM_ARRAY_TASK_ID", "one"}}), rollrig::InputError);
  CHECK_THROWS_AS(find_in({{"SLURM_ARRAY_TASK_ID", "9"}, {"SLURM_ARRAY_TASK_MIN", "1"}, {"SLURM_ARRAY_TASK_MAX", "3"}}),
                  rollrig::InputError);
  CHECK_THROWS_AS(find_in({{"SLURM_ARRAY_TASK_ID", "3"}}), rollrig::InputError);
  CHECK_THROWS_AS(find_in({{"OMPI_COMM_WORLD_RANK", "1"}}), rollrig::InputError);
  // "--array=1,3,7": parts 2, 4, 5 and 6 would never be carried out.
  CHECK_THROWS_AS(find_in({{"SLURM_ARRAY_TASK_ID", "3"},
                           {"SLURM_ARRAY_TASK_MIN", "1"},
                           {"SLURM_ARRAY_TASK_MAX", "7"},
                           {"SLURM_ARRAY_TASK_COUNT", "3"}}),
                  rollrig::InputError);
  CHECK_THROWS_AS(find_in({{"PMI_RANK", "3"}, {"PMI_SIZE", "3"}}), rollrig::InputError);
}
