#include "campaigns/items.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <regex>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include "campaigns/store.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"

namespace fs = std::filesystem;

namespace rollrig::campaigns {
namespace {

/// Beside the file of a part while a process writes it: nobody else can then read the file itself.
std::string progress_file_of(const std::string& results) { return results + ".progress"; }

std::string calc_identity(const CampaignFolder& folder, const Json& description, std::uint64_t seed) {
  return calc_sha256(folder.definition + to_text(description, -1) + std::to_string(seed));
}

/// Carries out one item. That it failed is a result, too.
Record carry_out_one(const ItemList& list, const CampaignFolder& folder, std::size_t item) {
  Record record;
  record.item = item;
  record.seed = calc_item_seed(folder.seed, item);
  record.identity = calc_identity(folder, list.describe(item), record.seed);
  const auto fail = [&record](const std::exception& error) {
    record.failure = boost::algorithm::replace_all_copy(std::string(error.what()), "\n", "; ");
  };
  try {
    record.result = to_text(list.carry_out(item, record.seed), -1);
  } catch (const RunFailure& failure) {
    fail(failure);
  } catch (const CampaignChanged&) {
    throw;
  } catch (const FileProblem&) {  // of the moment, such as a network drive that does not answer
    throw;
  } catch (const InputError& error) {  // such as a draw beyond what is allowed
    fail(error);
  }
  list.require_unchanged();
  return record;
}

/// Says once a second what the file of a part has, and takes that away at the end.
class ProgressFile {
 public:
  explicit ProgressFile(std::string path) : path_(std::move(path)) {}
  ~ProgressFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  ProgressFile(const ProgressFile&) = delete;
  ProgressFile& operator=(const ProgressFile&) = delete;

  void write(const Tally& tally) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::seconds(1);
    try {
      write_file_atomically(path_, to_text(Json{{"done", tally.done}, {"failed", tally.failed}}) + "\n");
    } catch (const InputError&) {  // results are worth more than the word on how many there are
    }
  }

  /// What a process says; nothing where it has just begun, or just ended.
  static Tally read(const std::string& path) {
    std::ifstream in(path);
    const Json said = Json::parse(in, nullptr, false);
    const auto read_count = [&said](const char* key) {
      const bool is_count = said.is_object() && said.contains(key) && said[key].is_number_unsigned();
      return is_count ? said[key].get<std::size_t>() : 0;
    };
    return {0, read_count("done"), read_count("failed")};
  }

 private:
  std::string path_;
  std::chrono::steady_clock::time_point next_{};
};

/// The items that some files have.
struct DoneItems {
  std::vector<bool> is_done;
  std::vector<bool> has_failed;

  explicit DoneItems(std::size_t items) : is_done(items), has_failed(items) {}

  void add(const std::string& file, std::size_t item, bool failed) {
    if (item >= is_done.size()) {
      throw InputError(
          {fmt::format("item {} of {}", item + 1, is_done.size()), file, 0, "", "", "items that the campaign has", ""});
    }
    is_done[item] = true;
    has_failed[item] = failed;
  }

  void add(const CampaignFolder& folder, const std::string& file) {
    read_items(file, folder.definition, [&](std::size_t item, bool failed) { add(file, item, failed); });
  }

  /// Of a part alone.
  Tally count(const Part& part) const {
    Tally tally{part.count_of(is_done.size()), 0, 0};
    for (std::size_t item = part.number - 1; item < is_done.size(); item += part.count) {
      if (is_done[item]) ++tally.done;
      if (has_failed[item]) ++tally.failed;
    }
    return tally;
  }
};

/// Files of other numbers of parts that nobody writes now. Other parts of the same number have no items of this one,
/// and their processes are left alone.
std::vector<std::string> list_other_splits(const CampaignFolder& folder, const Part& part) {
  const std::string own = folder.file_of(part);
  const std::string same_split = own.substr(own.rfind("_of_"));
  std::vector<std::string> others;
  for (const std::string& file : folder.list_files()) {
    if (!boost::algorithm::ends_with(file, same_split) && !is_in_use(file)) others.push_back(file);
  }
  return others;
}

}  // namespace

std::string CampaignFolder::file_of(const Part& part) const {
  return (fs::path(path) / fmt::format("results_{:04}_of_{:04}.sqlite", part.number, part.count)).string();
}

std::vector<std::string> CampaignFolder::list_files() const {
  static const std::regex name("results(_[0-9]+_of_[0-9]+)?\\.sqlite");
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const bool is_file = entry.is_regular_file() && !entry.is_symlink();
    const std::string file = entry.path().filename().string();
    if (is_file && file.size() < 64 && std::regex_match(file, name)) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::uint64_t calc_item_seed(std::uint64_t campaign_seed, std::size_t item) {
  const std::string hash = calc_sha256(fmt::format("seed {} item {}", campaign_seed, item));
  return std::strtoull(hash.substr(0, 8).c_str(), nullptr, 16) >> 1U;
}

Tally carry_out_items(const ItemList& list, const CampaignFolder& folder, const Part& part, int threads,
                      const std::function<void(double)>& advance) {
  DoneItems done(list.count());
  for (const std::string& file : list_other_splits(folder, part)) done.add(folder, file);
  const std::string path = folder.file_of(part);
  Tally tally = done.count(part);
  if (tally.done == tally.items && !is_there(path)) return tally;
  Store store(path, folder.definition);
  ProgressFile progress(progress_file_of(path));  // only now: another process may work on the part
  Tally own;  // of this file: `status` adds it to those of the files that it can read
  store.list_items([&](std::size_t item, bool has_failed) {
    done.add(path, item, has_failed);
    ++own.done;
    if (has_failed) ++own.failed;
  });
  tally = done.count(part);
  progress.write(own);
  std::vector<std::size_t> open;
  for (std::size_t item = part.number - 1; item < list.count(); item += part.count) {
    if (!done.is_done[item]) open.push_back(item);
  }
  std::size_t finished = 0;
  std::mutex mutex;
  parallel_for(open.size(), threads, [&](std::size_t i) {
    const Record record = carry_out_one(list, folder, open[i]);
    const std::lock_guard<std::mutex> lock(mutex);
    store.write(record);
    for (Tally* counts : {&tally, &own}) {
      ++counts->done;
      if (!record.failure.empty()) ++counts->failed;
    }
    progress.write(own);
    ++finished;
    if (advance) advance(static_cast<double>(finished) / static_cast<double>(open.size()));
  });
  store.close();
  return tally;
}

FolderState read_state(const CampaignFolder& folder, std::size_t items) {
  FolderState state;
  DoneItems done(items);
  for (const std::string& file : folder.list_files()) {
    if (is_in_use(file)) {
      state.running.push_back(file);
    } else {
      done.add(folder, file);
    }
  }
  state.tally = done.count({1, 1});
  for (const std::string& file : state.running) {
    const Tally said = ProgressFile::read(progress_file_of(file));
    state.tally.done = std::min(items, state.tally.done + said.done);
    state.tally.failed = std::min(items, state.tally.failed + said.failed);
  }
  return state;
}

}  // namespace rollrig::campaigns
