#pragma once
/// What is fuzzed: every reader of files and texts that a user gives, each as one function of bytes.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rollrig::fuzz {

/// A reader. It may refuse what it is given by InputError or RunFailure; anything else that it throws is a defect.
struct Target {
  std::string name;
  /// Files that the reader opens in its folder, in the order of the parts of an input. Empty: the reader takes a text.
  std::vector<std::string> files;
  /// Reads the text, or the folder that holds the files.
  std::function<void(const std::string&)> read;
  /// Well-formed inputs and inputs with mistakes, as parts.
  std::function<std::vector<std::string>()> make_seeds;
};

const std::vector<Target>& list_targets();
/// Throws std::out_of_range where no target has this name.
const Target& find_target(const std::string& name);

/// One input of several files: the parts, with a line of kPartMark between them.
std::string join_parts(const std::vector<std::string>& parts);
std::vector<std::string> split_parts(std::string_view input);

/// Gives an input to a target's reader, files within `folder`.
void execute(const Target& target, std::string_view input, const std::string& folder);

}  // namespace rollrig::fuzz
