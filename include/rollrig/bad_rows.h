#pragma once
/// What is done with rows of a CSV file that cannot be used.

#pragma GCC visibility push(default)
namespace rollrig {

/// A row is bad if it has the wrong number of fields, a text in the place of a number, no number where one is needed, a
/// number out of range, or a time that does not increase.
enum class BadRows {
  kRefuse,   // an InputError that lists the bad rows of all files
  kLeaveOut  // left out, as long as there are few of them; the results say which (docs/formats.md)
};

}  // namespace rollrig
#pragma GCC visibility pop
