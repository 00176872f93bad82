#pragma once
/// A bank of the foreign generator: sets that anyone may read, and a truth under seal.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rollrig::proof {

/// Names of the folders in <bank>/sets, sorted. Throws InputError where there is none. Opens no file.
std::vector<std::string> list_sets(const std::string& bank);

/// Folder of a set.
std::string set_folder(const std::string& bank, const std::string& set);

/// SHA-256 over names and contents of all files of a set.
std::string hash_set(const std::string& folder);

/// An effect that a set has.
struct TrueEffect {
  std::string id;
  double size = std::numeric_limits<double>::quiet_NaN();
  double neutral = 0.0;  // size at which it does nothing; infinite where that is none
  std::string unit;
  std::string size_class;  // "" where the bank has no classes
};

/// What the seal says of a set.
struct Truth {
  std::string set;
  std::vector<TrueEffect> effects;  // none, one, or two
  std::string campaign;             // kind of campaign, or kind of set
  double signal_floors = 0.0;       // of the channel that shows most, in noise floors
  bool outside = false;             // not in the catalog

  /// "none", or the effects joined by "+".
  std::string name() const;
  std::vector<std::string> ids() const;
};

/// Opens truth.json of a bank.
/// Errors  InputError: no such file; its SHA-256 is not `seal`, or where that is empty not that of seal.sha256; not
///         the truth of this bank's sets; a set whose files are not those whose hash is under the seal
std::vector<Truth> open_truth(const std::string& bank, const std::string& seal);

}  // namespace rollrig::proof
