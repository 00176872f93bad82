#pragma once
/// Which part of a campaign's items a process carries out.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace rollrig::campaigns {

/// Part `number` of `count` parts, from 1. It has one of the first `count` items, one of the next `count` items, and so
/// on. Neighboring items, which often take equally long, thus go to different processes. Which one it has is
/// pseudorandom from block to block, so that the values of a grid's last factor are spread over all parts, too.
struct Part {
  std::size_t number = 1;
  std::size_t count = 1;

  /// Its item in a block: one of block * count to block * count + count - 1.
  std::size_t item_of(std::size_t block) const;
  bool has(std::size_t item) const { return item_of(item / count) == item; }
  /// How many of the first `items` items it has.
  std::size_t count_of(std::size_t items) const;
};

/// "3/10" as --shard has it. Throws InputError.
Part read_part(const std::string& text);

/// Looks up a variable of the environment; null where there is none, as getenv().
using Environment = std::function<const char*(const char*)>;

/// The part that a batch system or an MPI launcher gives this process: of a job array (SLURM_ARRAY_TASK_ID with _MIN,
/// _MAX, _STEP, _COUNT; SGE_TASK_ID with _FIRST, _LAST, _STEPSIZE), of the processes of one launcher (SLURM_PROCID with
/// SLURM_STEP_NUM_TASKS; OMPI_COMM_WORLD_RANK and others with _SIZE), or of both: each task of the array then divides
/// its part among its processes. None where the process was started by itself.
/// Source   sbatch(1), srun(1), mpirun(1), qsub(1)
/// Errors   InputError: a variable that is no number, a number beyond what it counts, a job array with gaps, a process
///          that is told its number and not how many there are (PBS_ARRAY_INDEX, LSB_JOBINDEX, PMIX_RANK)
std::optional<Part> find_part(const Environment& environment);
/// Of the processes that one launcher has started alone.
std::optional<Part> find_process_part(const Environment& environment);
/// Whether this process is a task of a job array of any batch system that part.cpp knows.
bool is_array_task(const Environment& environment);
/// Whether a launcher has started this process together with others that it can talk to over MPI.
bool is_started_for_mpi(const Environment& environment);

}  // namespace rollrig::campaigns
