#pragma once
/// The tests that a diagnosis proposed, done: once the truth may be opened.

#include <string>

#include "validation/generator/upper_bound.h"
#include "validation/generator/validation_set.h"

namespace rollrig::generator {

struct FollowUpOrder {
  std::string set;
  bool drawn = false;  // tests drawn from the menu instead of those proposed
  int threads = 0;     // cases at a time; 0: as many as there are cores
};

/// Folder of a validation set with plans and the cases made by them.
std::string follow_up_folder(const FollowUpOrder& order);

/// For each plan in <folder>/plans/<number>/ the case with the planned runs after its own, in
/// <folder>/sets/<number>/: the same specimen, effects with their sizes, forms and shapes, and sensors; a session that
/// the case does not have has offsets of its own. A function of the truth and the plans. Returns how many cases there
/// are.
///
/// Errors   InputError: no plans; a plan of no case of this set, or of other files; truth or cases are not those of
///          this program's set; cases are there already
/// Checked  tests/validation/generator/follow_up_test.cpp
std::size_t write_follow_up(const FollowUpOrder& order, const Progress& progress);

/// The files of one case with the runs of the plan in a folder after its own. `truth` is that of the case.
/// Errors  InputError: as write_follow_up()
Files make_follow_up(const std::string& set, const std::string& number, const Json& truth,
                     const std::string& plan_folder);

/// Upper bound of a case with the runs of the plan in `plan_folder`; where that is empty, of the case alone.
/// Errors  InputError: as write_follow_up()
UpperBound find_upper_bound_after(const std::string& set, const std::string& number, const Json& truth,
                                  const std::string& plan_folder);

}  // namespace rollrig::generator
