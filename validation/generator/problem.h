#pragma once
/// What a user's mistake is answered with. The generator shares no code with the simulator, so it has its own.

#include <stdexcept>
#include <string>
#include <vector>

namespace blind {

/// What a message about a mistake has to say. Empty members are left out.
struct Problem {
  std::string what;     // one sentence
  std::string key;      // option
  std::string value;    // as given
  std::string allowed;  // what would have been right
  std::string nearest;  // nearest known name
};

/// A mistake in what the user gave: exit status 2, nothing written.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const Problem& problem);
};

/// The run itself failed: exit status 3.
class RunFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The known name nearest to `name`, or an empty string when none is near.
std::string find_nearest(const std::string& name, const std::vector<std::string>& known);

}  // namespace blind
