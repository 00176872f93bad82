#pragma once
/// Carries out the items of a campaign: those that are not done yet, of one part of them.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "campaigns/part.h"
#include "campaigns/store.h"
#include "include/rollrig/error.h"
#include "sim/core/json.h"

namespace rollrig::campaigns {

/// What the items of a campaign are made from has changed: no item can be carried out.
class CampaignChanged : public InputError {
 public:
  using InputError::InputError;
};

/// A list of items, each of which can be carried out without the others, on any machine, in any order, with the same
/// result to the bit.
class ItemList {
 public:
  virtual ~ItemList() = default;

  virtual std::size_t count() const = 0;
  /// What tells the item from the others, for its identity and for people.
  virtual Json describe(std::size_t item) const = 0;
  /// The result. Throws RunFailure or InputError for an item that cannot be carried out, CampaignChanged, FileProblem
  /// and Interrupted where no item can be. Called from several threads.
  virtual Json carry_out(std::size_t item, std::uint64_t seed) const = 0;
  /// Of an item of a campaign with this seed; carry_out() gets it.
  virtual std::uint64_t calc_seed(std::size_t item, std::uint64_t campaign_seed) const;
  /// Throws CampaignChanged if what the items are made from, such as a file, is no longer what it was. Called after
  /// each item, before its result counts. A list may check this in carry_out() instead, and leave this empty.
  virtual void require_unchanged() const {}
};

/// Where a campaign is, and what it is.
struct CampaignFolder {
  std::string path;
  std::string definition;  // SHA-256 of what defines it, such as campaign.json; tells its results from those of others
  std::uint64_t seed = 1;  // from which those of the items follow

  /// The file of a part's results: "results_0003_of_0010.sqlite".
  std::string file_of(const Part& part) const;
  /// The file of a process to which items are handed out: "results_mpi_0003_of_0010.sqlite".
  std::string file_of_worker(const Part& worker) const;
  /// All results files, "results.sqlite" and those of processes, by name.
  std::vector<std::string> list_files() const;
};

/// The seed of an item: the first 53 bits of SHA-256 over the campaign's seed and the item, so that
/// a double, as in JSON and .mat, holds it.
std::uint64_t calc_item_seed(std::uint64_t campaign_seed, std::size_t item);

/// How far a campaign is.
struct Tally {
  std::size_t items = 0;  // in all
  std::size_t done = 0;   // carried out, with those that failed
  std::size_t failed = 0;

  /// One more item.
  void add(bool has_failed) {
    ++done;
    if (has_failed) ++failed;
  }
};

/// Carries out some items, without a file. `visit` is called with each record as soon as it is there, one at a
/// time, in no order; `advance` is called after it, with the fraction of the items that is done. Throws Interrupted,
/// and InputError as ItemList does.
void carry_out_each(const ItemList& list, const CampaignFolder& folder, const std::vector<std::size_t>& items,
                    int threads, const std::function<void(const Record&)>& visit,
                    const std::function<void(double)>& advance = {});

/// The same of all items of the list.
void carry_out_all(const ItemList& list, const CampaignFolder& folder, int threads,
                   const std::function<void(const Record&)>& visit, const std::function<void(double)>& advance = {});

/// The items that no file of the folder has, and how many there are that one has. Throws InputError where a process
/// writes one of the files.
struct OpenItems {
  std::vector<std::size_t> items;
  Tally tally;
};
OpenItems find_open_items(const ItemList& list, const CampaignFolder& folder);

/// The results file of this process, and the file beside it that tells other processes how many items are done.
class ResultsFile {
 public:
  /// `is_elsewhere` says which items other files have, which are not to be counted twice: after a merge that was cut
  /// short, for example. Throws InputError as Store does.
  ResultsFile(const std::string& path, const CampaignFolder& folder, const std::vector<bool>& is_elsewhere = {});
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// What it has from an earlier session.
  void list_items(const std::function<void(std::size_t item, bool has_failed)>& visit) const;
  void write(const Record& record);
  /// Writes the content of the log into the file, which is then complete without it. Throws InputError where that
  /// cannot be.
  void close();

 private:
  class Progress;

  Store store_;
  std::unique_ptr<Progress> progress_;  // only after the store: another process may write the file
  Tally tally_;                         // of this file: `status` adds it to those of the files that it can read
};

/// Carries out the items of a part that no file of the folder has, and writes each as soon as it is done. `advance` is
/// called after each item, with the fraction of these items that is done. What another process does at the same time
/// with another number of parts is not known, and may be done twice. Throws Interrupted, and InputError as Store and
/// ItemList::require_unchanged() do; what was done stays.
Tally carry_out_items(const ItemList& list, const CampaignFolder& folder, const Part& part, int threads,
                      const std::function<void(double)>& advance = {});

/// Removes the `.progress` file that a killed process left beside a results file.
void remove_progress(const std::string& results);

/// What is done of all items. Files that a process writes now are counted by what it says in `<file>.progress`.
struct FolderState {
  Tally tally;
  std::vector<std::string> running;  // files that a process writes now
};
FolderState read_state(const CampaignFolder& folder, std::size_t items);

}  // namespace rollrig::campaigns
