#include "campaigns/part.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::campaigns {
namespace {

constexpr double kMostParts = 1e6;  // Assumed

bool is_count(double number) { return number >= 0.0 && number <= 1e15 && number == std::floor(number); }

/// What starts several processes of a program, and the variables by which it tells each process its number, from 0,
/// and how many there are.
struct Launcher {
  const char* rank;
  const char* size;  // null where the environment does not say it
  bool is_for_mpi;   // its processes can talk to each other over MPI
};

constexpr std::array<Launcher, 7> kLaunchers{{
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", true},  // mpirun of Open MPI
    {"PMI_RANK", "PMI_SIZE", true},                          // mpirun of MPICH; srun --mpi=pmi2
    {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE", true},    // mpirun_rsh of MVAPICH
    {"JSM_NAMESPACE_RANK", "JSM_NAMESPACE_SIZE", true},      // jsrun of IBM
    {"FLUX_TASK_RANK", "FLUX_JOB_SIZE", false},              // flux run
    {"PMIX_RANK", nullptr, true},                            // srun --mpi=pmix, of which the next line says the size
    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", false},         // the latter is set by srun alone
}};

/// What Grid Engine sets its variables to in a job without an array.
constexpr const char* kNoGridEngineArray = "undefined";

/// A job array whose tasks are told their number, and not how many there are.
struct UncountedArray {
  const char* task;
  const char* means_none;  // value outside of an array
};

constexpr std::array<UncountedArray, 6> kUncountedArrays{{
    {"PBS_ARRAY_INDEX", ""},            // PBS Professional
    {"PBS_ARRAYID", ""},                // Torque
    {"LSB_JOBINDEX", "0"},              // LSF
    {"OAR_ARRAY_INDEX", ""},            // OAR
    {"AWS_BATCH_JOB_ARRAY_INDEX", ""},  // AWS Batch
    {"JOB_COMPLETION_INDEX", ""},       // Kubernetes
}};

/// Whether a variable says something else than that there is no array.
bool is_set(const Environment& environment, const char* name, const std::string& means_none) {
  const char* value = environment(name);
  return value != nullptr && *value != '\0' && value != means_none;
}

/// Throws InputError if this process is one of several and the environment does not say how many there are.
void refuse_uncounted(const Environment& environment, bool is_process_counted) {
  const auto refuse = [](const char* name, const char* value) {
    throw InputError(
        {fmt::format("the variable {} says which of several processes this one is, and none says how many "
                     "there are",
                     name),
         "environment", 0, name, value,
         fmt::format("--shard I/N: N the number of all processes, I from 1 to N, which ${} gives (add 1 where it "
                     "counts from 0)",
                     name),
         ""});
  };
  for (const UncountedArray& array : kUncountedArrays) {
    if (is_set(environment, array.task, array.means_none)) refuse(array.task, environment(array.task));
  }
  for (const char* rank : {"PMIX_RANK", "PALS_RANKID"}) {  // the latter of HPE's mpiexec
    const char* number = environment(rank);
    if (number != nullptr && !is_process_counted) refuse(rank, number);
  }
}

/// A variable's whole number, none where it is not set.
std::optional<std::size_t> read_count(const Environment& environment, const char* name) {
  const char* text = environment(name);
  if (text == nullptr || *text == '\0' || std::string(text) == kNoGridEngineArray) return std::nullopt;
  const std::optional<double> number = parse_number(text);
  if (number.has_value() && is_count(*number)) return static_cast<std::size_t>(*number);
  throw InputError({fmt::format("the variable {} is no whole number", name), "environment", 0, name, text,
                    "what the batch system sets, or --shard I/N", ""});
}

/// Of a variable that is there whenever `beside` is.
std::size_t require_count(const Environment& environment, const char* name, const char* beside) {
  const std::optional<std::size_t> count = read_count(environment, name);
  if (count.has_value()) return *count;
  throw InputError({fmt::format("the variable {} is set, and {} is not", beside, name), "environment", 0, name, "",
                    "what the batch system sets, or --shard I/N", ""});
}

Part make_part(const char* name, std::size_t part, std::size_t parts) {
  if (part >= 1 && part <= parts && static_cast<double>(parts) <= kMostParts) return {part, parts};
  throw InputError({fmt::format("the variable {} says part {} of {}", name, part, parts), "environment", 0, name, "",
                    "what the batch system sets, or --shard I/N", ""});
}

/// Of a job array whose tasks are numbered from `first` to `last`, `step` apart.
Part make_array_part(const char* name, std::size_t id, std::size_t first, std::size_t last, std::size_t step) {
  step = std::max<std::size_t>(step, 1);
  if (id < first || last < first) {
    throw InputError({fmt::format("the variable {} says task {}, outside of {} to {}", name, id, first, last),
                      "environment", 0, name, std::to_string(id), "what the batch system sets, or --shard I/N", ""});
  }
  return make_part(name, (id - first) / step + 1, (last - first) / step + 1);
}

std::optional<Part> find_array_part(const Environment& environment) {
  if (const auto id = read_count(environment, "SLURM_ARRAY_TASK_ID")) {
    const std::size_t first = require_count(environment, "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_ID");
    const std::size_t last = require_count(environment, "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_ID");
    const Part part = make_array_part("SLURM_ARRAY_TASK_ID", *id, first, last,
                                      read_count(environment, "SLURM_ARRAY_TASK_STEP").value_or(1));
    const std::size_t tasks = read_count(environment, "SLURM_ARRAY_TASK_COUNT").value_or(part.count);
    if (tasks == part.count) return part;
    throw InputError({fmt::format("the job array has gaps: {} tasks, numbered up to {}", tasks, last), "environment", 0,
                      "SLURM_ARRAY_TASK_COUNT", std::to_string(tasks),
                      "--array=1-N; or --shard I/N, to carry out some parts alone", ""});
  }
  if (const auto id = read_count(environment, "SGE_TASK_ID")) {
    return make_array_part("SGE_TASK_ID", *id, require_count(environment, "SGE_TASK_FIRST", "SGE_TASK_ID"),
                           require_count(environment, "SGE_TASK_LAST", "SGE_TASK_ID"),
                           read_count(environment, "SGE_TASK_STEPSIZE").value_or(1));
  }
  return std::nullopt;
}

/// The number that digits alone write; 0 where there is anything else, or too many of them.
std::size_t read_digits(const std::string& text) {
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? number : 0;
}

/// A pseudorandom hash of a number. Source: Steele, Lea, Flood, OOPSLA 2014, SplitMix64
std::uint64_t mix(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15U;
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

}  // namespace

std::size_t Part::item_of(std::size_t block) const { return block * count + (number - 1 + mix(block) % count) % count; }

std::size_t Part::count_of(std::size_t items) const {
  const std::size_t blocks = items / count;
  return blocks + (item_of(blocks) < items ? 1 : 0);
}

Part read_part(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::size_t part = read_digits(text.substr(0, slash));
  const std::size_t parts = slash < text.size() ? read_digits(text.substr(slash + 1)) : 0;
  if (part >= 1 && part <= parts && static_cast<double>(parts) <= kMostParts) return {part, parts};
  throw InputError({fmt::format("--shard '{}' is no part", text), "command line", 0, "--shard", text,
                    fmt::format("I/N with 1 <= I <= N <= {:.0f}, as 3/10", kMostParts), ""});
}

// mpirun and srun stand before the batch job's own variables, which are also there in a job's script, where a program
// runs once.
std::optional<Part> find_process_part(const Environment& environment) {
  for (const Launcher& launcher : kLaunchers) {
    if (launcher.size == nullptr) continue;
    const auto rank = read_count(environment, launcher.rank);
    if (!rank.has_value()) continue;
    const std::optional<std::size_t> size = launcher.is_for_mpi
                                                ? require_count(environment, launcher.size, launcher.rank)
                                                : read_count(environment, launcher.size);
    if (size.has_value()) return make_part(launcher.rank, *rank + 1, *size);
  }
  return std::nullopt;
}

bool is_array_task(const Environment& environment) {
  const auto is_task_of = [&environment](const UncountedArray& array) {
    return is_set(environment, array.task, array.means_none);
  };
  return is_set(environment, "SLURM_ARRAY_TASK_ID", "") || is_set(environment, "SGE_TASK_ID", kNoGridEngineArray) ||
         std::any_of(kUncountedArrays.begin(), kUncountedArrays.end(), is_task_of);
}

bool is_started_for_mpi(const Environment& environment) {
  const auto has_rank = [&environment](const Launcher& launcher) {
    return launcher.is_for_mpi && environment(launcher.rank) != nullptr;
  };
  return std::any_of(kLaunchers.begin(), kLaunchers.end(), has_rank);
}

std::optional<Part> find_part(const Environment& environment) {
  const std::optional<Part> array = find_array_part(environment);
  const std::optional<Part> process = find_process_part(environment);
  refuse_uncounted(environment, process.has_value());
  if (!array.has_value() || !process.has_value()) return array.has_value() ? array : process;
  const bool is_slurm = environment("SLURM_ARRAY_TASK_ID") != nullptr;
  return make_part(is_slurm ? "SLURM_ARRAY_TASK_ID" : "SGE_TASK_ID",
                   (array->number - 1) + array->count * (process->number - 1) + 1, array->count * process->count);
}

}  // namespace rollrig::campaigns
