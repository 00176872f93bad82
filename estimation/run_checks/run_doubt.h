#pragma once
/// What speaks against a run of a set.

#include <string>
#include <vector>

namespace rollrig::estimation {

enum class DoubtKind {
  kRepeat,    // the recording of another run
  kLabels,    // speeds of bins that distance and time contradict
  kTimes,     // times that do not add up
  kDistance,  // a distance that speeds and times contradict
  kState,     // loaded and lifted mistaken for each other
  kLoad,      // loads that differ in a group of repeats
  kOdd        // does not agree with the others
};

/// A doubt about one run or several.
struct RunDoubt {
  DoubtKind kind = DoubtKind::kOdd;
  std::vector<std::string> runs;  // names, as files give them
  std::string likely;             // the likely mistake, in a few words; empty where nothing tells
  double relative = 0.0;          // by how much it is off; 0 where there is no such number
  std::string text;               // a sentence
};

inline const char* name_of(DoubtKind kind) {
  switch (kind) {
    case DoubtKind::kRepeat:
      return "repeat";
    case DoubtKind::kLabels:
      return "bin labels";
    case DoubtKind::kTimes:
      return "times";
    case DoubtKind::kDistance:
      return "distance";
    case DoubtKind::kState:
      return "state";
    case DoubtKind::kLoad:
      return "load";
    case DoubtKind::kOdd:
      break;
  }
  return "odd run";
}

}  // namespace rollrig::estimation
