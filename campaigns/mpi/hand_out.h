#pragma once
/// The items of a campaign, handed out one after the other to the processes that mpirun has started.

#include <functional>

#include "campaigns/items.h"
#include "campaigns/mpi/ranks.h"

namespace rollrig::campaigns {

/// Carries out the items that no file of the folder has. The first process hands them out, a few at a time, and each
/// of the others asks for more when it is done; each has a results file of its own and carries out one item at a
/// time. The first one sleeps between two questions, so that it needs no core.
///
/// To be called by all processes. `advance` is called in the first one, with the fraction of these items that is done.
/// What is returned counts all items, in the first process; the others return nothing of use. If a process fails, the
/// program ends the others by end_other_processes(); what was done stays.
/// Source  after the guided self-scheduling of Polychronopoulos and Kuck, IEEE Trans. Comput. C-36 (1987) 1425; Assumed:
///         a quarter of their share at once
/// Errors  InputError: fewer than two processes; built without MPI; another process writes a results file; as
///         carry_out_items(). Interrupted
Tally hand_out_items(const ItemList& list, const CampaignFolder& folder, const Ranks& ranks,
                     const std::function<void(double)>& advance = {});

/// How many items the first process hands out at once, where so many are left: a quarter of an even share, so that the
/// last ones are single and the processes end together; between 1 and 64.
std::size_t calc_chunk(std::size_t items_left, std::size_t workers);

}  // namespace rollrig::campaigns
