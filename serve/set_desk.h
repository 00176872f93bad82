#pragma once
/// Dropped sets: files come in, columns are guessed and confirmed, the set is validated and diagnosed.

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "serve/jobs.h"
#include "serve/kept_pages.h"
#include "serve/set_folder.h"
#include "serve/shelf.h"

namespace rollrig::serve {

/// What a dropped folder is, by what lies in it.
enum class DroppedKind {
  kSet,      // it has a set.toml
  kMapping,  // it has an import.toml
  kLogs      // logs alone
};

class SetDesk {
 public:
  SetDesk(const Shelf& shelf, KeptPages& kept, Jobs& jobs, int threads);

  /// Begins a set; beyond a few, the oldest goes. {set: id, name}
  Json open(const Json& request);
  /// Where a file comes in. `bytes` is its length as the request says it. Throws Refusal.
  std::unique_ptr<IncomingFile> take_file(int id, const std::string& name, std::uint64_t bytes);

  /// What the files are, and for logs what their columns are taken to be: {kind, name, files, tires, rigs, headings,
  /// targets, guesses, columns, problem}. `request` is what the person says: {tire, rig, vehicle, name, columns, units,
  /// values, date_order, cold_pressure_kPa, rests_min}, as the options of rollrig import --guess.
  Json guess(int id, const Json& request);
  /// Makes the set of what was confirmed, and validates it: {what, warnings, is_good, text}.
  Json make_set(int id, const Json& request);
  /// {job}: the diagnosis of the validated set; its result is {page, kept, verdict}.
  Json diagnose(int id, const Json& request);

  /// The private folder of all sets.
  const std::string& folder() const { return folder_.path(); }
  /// The part of paths in messages that a person does not know.
  std::string private_part(int id) const { return logs_of(id) + "/"; }

 private:
  struct DroppedSet {
    std::string name;
    std::size_t files = 0;
    std::uint64_t bytes = 0;
    bool is_made = false;
  };

  std::string logs_of(int id) const { return fmt::format("{}/{}/files", folder_.path(), id); }
  std::string made_of(int id) const { return fmt::format("{}/{}/set", folder_.path(), id); }
  DroppedSet copy_of(int id) const;
  DroppedKind find_kind(int id) const;
  std::string set_folder_of(int id) const { return find_kind(id) == DroppedKind::kSet ? logs_of(id) : made_of(id); }
  GuessOptions read_options(int id, const Json& request) const;
  std::string find_asset(int id, const char* kind, const std::string& name) const;

  const Shelf& shelf_;
  KeptPages& kept_;
  Jobs& jobs_;
  int threads_;
  PrivateFolder folder_;
  mutable std::mutex mutex_;
  std::map<int, DroppedSet> sets_;
  int next_ = 1;
};

}  // namespace rollrig::serve
