#pragma once
/// Which part of a campaign's items a process carries out.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace rollrig::campaigns {

/// Part `part` of `parts`, from 1: items part - 1, part - 1 + parts, part - 1 + 2 parts, ... Neighboring items, which
/// often take equally long, thus go to different processes.
struct Share {
  std::size_t part = 1;
  std::size_t parts = 1;

  bool has(std::size_t item) const { return item % parts == part - 1; }
  /// Of so many items, how many it has.
  std::size_t count(std::size_t items) const { return items / parts + (items % parts >= part ? 1 : 0); }
};

/// "3/10" as --shard has it. Throws InputError.
Share read_share(const std::string& text);

/// Looks up a variable of the environment; null where there is none, as getenv().
using Environment = std::function<const char*(const char*)>;

/// The share that a batch system or an MPI launcher gives this process: of a job array (SLURM_ARRAY_TASK_ID with
/// _MIN, _COUNT, _STEP; SGE_TASK_ID with _FIRST, _LAST, _STEPSIZE), of the tasks of a job (SLURM_PROCID with
/// SLURM_NTASKS; OMPI_COMM_WORLD_RANK, PMI_RANK with _SIZE), or of both: each task of the array then shares its part
/// among its processes. None where the process was started by itself.
/// Source   sbatch(1), srun(1), mpirun(1), qsub(1)
/// Errors   InputError: a variable that is no number, or a number beyond what it counts
std::optional<Share> find_share(const Environment& environment);

}  // namespace rollrig::campaigns
