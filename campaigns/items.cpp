#include "campaigns/items.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include "campaigns/store.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"

namespace fs = std::filesystem;

namespace rollrig::campaigns {
namespace {

/// Beside the file of a share while a process writes it: nobody else can then read the file itself.
std::string progress_file_of(const std::string& results) { return results + ".progress"; }

std::string calc_identity(const CampaignFolder& folder, const Json& description, std::uint64_t seed) {
  return calc_sha256(folder.definition + to_text(description, -1) + std::to_string(seed));
}

/// Carries out one item; a failure is what it came to.
Record make_record(const ItemList& list, const CampaignFolder& folder, std::size_t item) {
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
  } catch (const InputError& error) {  // such as a draw beyond what is allowed
    fail(error);
  }
  return record;
}

/// Says once a second how far a share is, and takes that away at the end.
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
    write_file_atomically(path_, to_text(Json{{"done", tally.done}, {"failed", tally.failed}}) + "\n");
  }

 private:
  std::string path_;
  std::chrono::steady_clock::time_point next_{};
};

/// The items that some files have.
struct DoneItems {
  std::vector<bool> is_done;
  std::vector<bool> has_failed;
};

DoneItems list_done(const CampaignFolder& folder, std::size_t items, const std::vector<std::string>& files) {
  DoneItems found{std::vector<bool>(items), std::vector<bool>(items)};
  for (const std::string& file : files) {
    read_items(file, folder.definition, [&](std::size_t item, bool has_failed) {
      if (item >= items) {
        throw InputError(
            {fmt::format("item {} of {}", item + 1, items), file, 0, "", "", "items that the campaign has", ""});
      }
      found.is_done[item] = true;
      found.has_failed[item] = has_failed;
    });
  }
  return found;
}

/// The files that may have items of a share: its own, and those of other splits that nobody writes now. Other shares
/// of the same split have none, and their processes are left alone.
std::vector<std::string> list_relevant(const CampaignFolder& folder, const Share& share) {
  std::vector<std::string> relevant;
  const std::string own = folder.file_of(share);
  const std::string same_split = own.substr(own.rfind("_of_"));
  for (const std::string& file : folder.list_files()) {
    const bool is_sibling = file != own && boost::algorithm::ends_with(file, same_split);
    if (!is_sibling && (file == own || !is_in_use(file))) relevant.push_back(file);
  }
  return relevant;
}

}  // namespace

std::string CampaignFolder::file_of(const Share& share) const {
  return (fs::path(path) / fmt::format("results_{:04}_of_{:04}.sqlite", share.part, share.parts)).string();
}

std::vector<std::string> CampaignFolder::list_files() const {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".sqlite") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::uint64_t calc_item_seed(std::uint64_t campaign_seed, std::size_t item) {
  const std::string hash = calc_sha256(fmt::format("seed {} item {}", campaign_seed, item));
  return std::strtoull(hash.substr(0, 8).c_str(), nullptr, 16) >> 1U;
}

Tally carry_out_items(const ItemList& list, const CampaignFolder& folder, const Share& share, int threads,
                      const std::function<void(double)>& advance) {
  const DoneItems before = list_done(folder, list.count(), list_relevant(folder, share));
  const std::string path = folder.file_of(share);
  Tally tally{share.count(list.count()), 0, 0};
  std::vector<std::size_t> open;
  for (std::size_t item = share.part - 1; item < list.count(); item += share.parts) {
    if (!before.is_done[item]) open.push_back(item);
    if (before.is_done[item]) ++tally.done;
    if (before.has_failed[item]) ++tally.failed;
  }
  if (open.empty()) return tally;
  Tally own;  // of this file: what another process adds to those of the files that it can read
  if (is_there(path)) {
    read_items(path, folder.definition, [&own](std::size_t, bool has_failed) {
      ++own.done;
      if (has_failed) ++own.failed;
    });
  }
  Store store(path, folder.definition);
  ProgressFile progress(progress_file_of(path));
  std::size_t finished = 0;
  std::mutex mutex;
  parallel_for(open.size(), threads, [&](std::size_t i) {
    const Record record = make_record(list, folder, open[i]);
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
  return tally;
}

FolderState read_state(const CampaignFolder& folder, std::size_t items) {
  FolderState state;
  std::vector<std::string> at_rest;
  for (const std::string& file : folder.list_files()) (is_in_use(file) ? state.running : at_rest).push_back(file);
  const DoneItems done = list_done(folder, items, at_rest);
  state.tally.items = items;
  const auto count = [](const std::vector<bool>& flags) {
    return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
  };
  state.tally.done = count(done.is_done);
  state.tally.failed = count(done.has_failed);
  for (const std::string& file : state.running) {
    std::ifstream in(progress_file_of(file));
    const Json said = Json::parse(in, nullptr, false);
    if (!said.is_object()) continue;  // it has just begun, or just ended
    state.tally.done += said.value("done", std::size_t{0});
    state.tally.failed += said.value("failed", std::size_t{0});
  }
  return state;
}

}  // namespace rollrig::campaigns
