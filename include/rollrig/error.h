#pragma once
/// What is thrown: the three ways in which a call stops short, each with an exit status of the program.

#include <stdexcept>
#include <string>

#pragma GCC visibility push(default)
namespace rollrig {

/// What a message about a user's mistake has to say. Empty members are left out.
struct InputProblem {
  std::string what;     // one sentence
  std::string file;     // or "--set", "command line"
  int line = 0;         // 1-based; 0 when there is none
  std::string key;      // key, column or option
  std::string value;    // as given
  std::string allowed;  // what would have been right
  std::string nearest;  // nearest known name
};

/// A mistake in what the user gave: exit status 2, nothing written.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputProblem problem);
  const InputProblem& problem() const { return problem_; }

 private:
  InputProblem problem_;
};

/// The run itself failed (an integration that does not converge, energy that does not close):
/// exit status 3.
class RunFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user asked to stop: exit status 130, nothing half-written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace rollrig
#pragma GCC visibility pop
