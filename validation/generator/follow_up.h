#pragma once
/// The tests that a diagnosis proposed, done: once the seal may be opened.

#include <cstddef>
#include <functional>
#include <string>

namespace blind {

struct FollowUpOrder {
  std::string bank;
  bool drawn = false;       // tests drawn from the menu instead of those proposed
  std::size_t threads = 0;  // sets at a time; 0: as many as there are cores
};

/// Folder of a bank with plans and the sets made by them.
std::string follow_up_folder(const FollowUpOrder& order);

/// For each plan in <folder>/plans/<set>/ the set with the planned runs after its own, in <folder>/sets/<set>/: the
/// same specimen, effects with their sizes, forms and shapes, and sensors; a session that the set does not have has
/// offsets of its own. A function of the bank's truth and the plans. Returns how many sets there are. Errors
/// InputError: no plans; a plan of no set of this bank, or of other files; the seal or the sets are not those of
///         this program's bank; sets are there already
/// Checked tests/validation/generator/follow_up_test.cpp
std::size_t write_follow_up(const FollowUpOrder& order, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace blind
