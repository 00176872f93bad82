#pragma once
/// The three ways in which the program stops short, each with its exit status.

#include <stdexcept>
#include <string>
#include <vector>

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

/// One labeled line of a message.
struct ProblemPart {
  const char* label;
  std::string content;
  bool is_copied = false;  // a place or a value, which a person copies: not to be broken
};

/// What a message says below its first sentence, in order.
std::vector<ProblemPart> list_parts(const InputProblem& problem);

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

/// The known name nearest to `name` by edit distance, or an empty string when none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// An InputProblem for a name that is not among the known ones.
InputProblem unknown_name(const std::string& kind, const std::string& name, const std::vector<std::string>& known);

}  // namespace rollrig
