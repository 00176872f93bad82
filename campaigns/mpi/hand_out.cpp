#include "campaigns/mpi/hand_out.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <thread>

#include "sim/core/error.h"
#include "sim/core/interrupt.h"

#ifdef ROLLRIG_MPI
#include <mpi.h>
#endif

namespace rollrig::campaigns {

std::size_t calc_chunk(std::size_t items_left, std::size_t workers) {
  constexpr std::size_t kMost = 64;  // Assumed: 64 items of 1 ms each take longer than the pause below
  return std::clamp<std::size_t>(items_left / (4 * workers), 1, kMost);
}

#ifdef ROLLRIG_MPI
namespace {

constexpr int kFirst = 0;  // the process that hands out
constexpr int kQuestion = 1;
constexpr int kAnswer = 2;
constexpr std::chrono::milliseconds kPause{1};

using Number = unsigned long long;
const MPI_Datatype kNumber = MPI_UNSIGNED_LONG_LONG;

/// What a process has done since its last question: items, and those of them that failed.
using Report = std::array<Number, 2>;

Tally hand_out(const ItemList& list, const CampaignFolder& folder, std::size_t workers,
               const std::function<void(double)>& advance) {
  OpenItems open = find_open_items(list, folder);
  std::size_t handed_out = 0;
  std::size_t at_work = workers;
  const std::size_t done_before = open.tally.done;
  while (at_work > 0) {
    throw_if_interrupted();
    int is_asked = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kQuestion, MPI_COMM_WORLD, &is_asked, &status);
    if (is_asked == 0) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    Report report{};
    MPI_Recv(report.data(), static_cast<int>(report.size()), kNumber, status.MPI_SOURCE, kQuestion, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    open.tally.done += report[0];
    open.tally.failed += report[1];
    const std::size_t left = open.items.size() - handed_out;
    const std::size_t count = left == 0 ? 0 : calc_chunk(left, workers);
    const std::vector<Number> answer(open.items.begin() + static_cast<std::ptrdiff_t>(handed_out),
                                     open.items.begin() + static_cast<std::ptrdiff_t>(handed_out + count));
    handed_out += count;
    MPI_Send(answer.data(), static_cast<int>(count), kNumber, status.MPI_SOURCE, kAnswer, MPI_COMM_WORLD);
    if (count == 0) --at_work;
    if (advance && report[0] > 0) {
      advance(static_cast<double>(open.tally.done - done_before) / static_cast<double>(open.items.size()));
    }
  }
  return open.tally;
}

/// The next items for this process; none at the end.
std::vector<std::size_t> ask(const Report& report) {
  MPI_Send(report.data(), static_cast<int>(report.size()), kNumber, kFirst, kQuestion, MPI_COMM_WORLD);
  MPI_Status status;
  MPI_Probe(kFirst, kAnswer, MPI_COMM_WORLD, &status);
  int count = 0;
  MPI_Get_count(&status, kNumber, &count);
  std::vector<Number> items(static_cast<std::size_t>(count));
  MPI_Recv(items.data(), count, kNumber, kFirst, kAnswer, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return {items.begin(), items.end()};
}

void work(const ItemList& list, const CampaignFolder& folder, const Part& worker) {
  std::optional<ResultsFile> file;  // opened once the first process has read what is there
  Report report{};
  for (std::vector<std::size_t> items = ask(report); !items.empty(); items = ask(report)) {
    if (!file.has_value()) file.emplace(folder.file_of_worker(worker), folder);
    report = {};
    carry_out_each(list, folder, items, 1, [&](const Record& record) {
      file->write(record);
      ++report[0];
      if (!record.failure.empty()) ++report[1];
    });
  }
  if (file.has_value()) file->close();
}

}  // namespace

Tally hand_out_items(const ItemList& list, const CampaignFolder& folder, const Ranks& ranks,
                     const std::function<void(double)>& advance) {
  if (ranks.count() < 2) {
    throw InputError({"one process hands out the items, and there is no other to carry them out", "command line", 0,
                      "--mpi", "", "mpirun -n N before rollrig, with N of 2 or more", ""});
  }
  const std::size_t workers = ranks.count() - 1;
  if (ranks.is_first()) return hand_out(list, folder, workers, advance);
  work(list, folder, {ranks.rank(), workers});
  return {};
}
#else
Tally hand_out_items(const ItemList&, const CampaignFolder&, const Ranks&, const std::function<void(double)>&) {
  throw InputError({"this rollrig was built without MPI", "command line", 0, "--mpi", "",
                    "--shard; or to install Open MPI (libopenmpi-dev, openmpi-bin) and to build rollrig anew", ""});
}
#endif

}  // namespace rollrig::campaigns
