#include "campaigns/items.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <mutex>
#include <numeric>
#include <regex>
#include <set>
#include <tuple>

#include <boost/algorithm/string/replace.hpp>

#include "campaigns/store.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"
#include "sim/core/parse_json.h"

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
  record.seed = list.calc_seed(item, folder.seed);
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

/// What a process says of the file that it writes; nothing where it has just begun, or just ended.
Tally read_progress(const std::string& results) {
  Json said;
  try {
    said = read_json(progress_file_of(results));
  } catch (const InputError&) {
  }
  const auto read_count = [&said](const char* key) {
    const bool is_count = said.is_object() && said.contains(key) && said[key].is_number_unsigned();
    return is_count ? said[key].get<std::size_t>() : 0;
  };
  return {0, read_count("done"), read_count("failed")};
}

/// How far the items of a sample are from being spread evenly: over the whole list, and over the values of every factor
/// that a grid of so many items may have, the first one or a later one. 0: the mean place of a first factor, and the
/// mean and the mean square of a later one, equal those of all items.
double calc_unevenness(const std::vector<std::size_t>& sample, std::size_t items,
                       const std::vector<std::size_t>& divisors) {
  double worst = 0.0;
  for (const std::size_t values : divisors) {
    double first = 0.0, last = 0.0, last_squared = 0.0;  // places among the values, from 0 to 1
    for (const std::size_t item : sample) {
      first += static_cast<double>(item * values / items) / static_cast<double>(values - 1);
      const double place = static_cast<double>(item % values) / static_cast<double>(values - 1);
      last += place;
      last_squared += place * place;
    }
    const auto count = static_cast<double>(sample.size());
    const auto n = static_cast<double>(values);
    const double mean_squared = (2.0 * n - 1.0) / (6.0 * (n - 1.0));
    worst = std::max({worst, std::abs(first / count - 0.5), std::abs(last / count - 0.5),
                      std::abs(last_squared / count - mean_squared)});
  }
  return worst;
}

/// The step between items that follow one another: item i of the order is i * step, modulo the items of the part. Each
/// comes once, since the two numbers have no common factor. Of steps near the golden section of the part, that whose
/// first tenth is spread most evenly: a tenth of the work then tells the time of the rest, whatever factor of a grid
/// the time of an item depends on.
std::size_t choose_step(const Part& part, std::size_t items_of_all) {
  constexpr std::size_t kMostSample = 500;  // Assumed: tells enough
  constexpr std::size_t kMostValues = 200;  // Assumed: of a factor; more are nearly continuous
  constexpr std::size_t kCandidates = 40;   // Assumed
  constexpr double kGolden = 0.6180339887498949;
  const std::size_t items = part.count_of(items_of_all);
  if (items == 0) return 1;
  std::vector<std::size_t> divisors;
  for (std::size_t values = 2; values <= std::min(kMostValues, items_of_all); ++values) {
    if (items_of_all % values == 0) divisors.push_back(values);
  }
  std::size_t best = 1;
  double least = std::numeric_limits<double>::infinity();
  auto step = std::max<std::size_t>(1, static_cast<std::size_t>(kGolden * static_cast<double>(items)));
  for (std::size_t candidate = 0; candidate < kCandidates && step < std::max<std::size_t>(items, 2); ++step) {
    if (std::gcd(step, items) > 1) continue;
    ++candidate;
    std::vector<std::size_t> sample;
    for (std::size_t i = 0; i < std::clamp<std::size_t>(items / 10, 1, kMostSample); ++i) {
      sample.push_back(part.item_of(i * step % items));
    }
    const double unevenness = calc_unevenness(sample, items_of_all, divisors);
    if (unevenness < least) std::tie(least, best) = std::make_pair(unevenness, step);
  }
  return best;
}

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
  /// The same of those files that no process writes now. Returns the others.
  std::vector<std::string> add_closed(const CampaignFolder& folder, const std::vector<std::string>& files) {
    std::vector<std::string> in_use = list_in_use(files);  // sooner than each of them is waited for
    for (const std::string& file : files) {
      if (std::find(in_use.begin(), in_use.end(), file) != in_use.end()) continue;
      try {
        add(folder, file);
      } catch (const FileInUse&) {  // since a moment
        in_use.push_back(file);
      }
    }
    return in_use;
  }

  /// Of a part alone, as the next one: equal steps through the part, as choose_step() has them.
  std::vector<std::size_t> list_open(const Part& part) const {
    const std::size_t items = part.count_of(is_done.size());
    const std::size_t step = choose_step(part, is_done.size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < items; ++i) {
      const std::size_t item = part.item_of(i * step % items);
      if (!is_done[item]) open.push_back(item);
    }
    return open;
  }

  Tally count(const Part& part) const {
    Tally tally{part.count_of(is_done.size()), 0, 0};
    for (std::size_t block = 0; block < tally.items; ++block) {
      const std::size_t item = part.item_of(block);
      if (is_done[item]) ++tally.done;
      if (has_failed[item]) ++tally.failed;
    }
    return tally;
  }
};

/// All results files but those of this division into parts. Besides the part's own file, only these can have items
/// of `part`.
std::vector<std::string> list_files_of_other_divisions(const CampaignFolder& folder, const Part& part) {
  std::set<std::string> same_division;
  for (std::size_t number = 1; number <= part.count; ++number)
    same_division.insert(folder.file_of({number, part.count}));
  std::vector<std::string> others;
  for (const std::string& file : folder.list_files()) {
    if (same_division.count(file) == 0) others.push_back(file);
  }
  return others;
}

}  // namespace

std::string CampaignFolder::file_of(const Part& part) const {
  return (fs::path(path) / fmt::format("results_{:04}_of_{:04}.sqlite", part.number, part.count)).string();
}

std::string CampaignFolder::file_of_worker(const Part& worker) const {
  return (fs::path(path) / fmt::format("results_mpi_{:04}_of_{:04}.sqlite", worker.number, worker.count)).string();
}

std::vector<std::string> CampaignFolder::list_files() const {
  static const std::regex name("results((_mpi)?_[0-9]+_of_[0-9]+)?\\.sqlite");
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const bool is_file = entry.is_regular_file() && !entry.is_symlink();
    const std::string file = entry.path().filename().string();
    if (is_file && file.size() < 64 && std::regex_match(file, name)) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::uint64_t ItemList::calc_seed(std::size_t item, std::uint64_t campaign_seed) const {
  return calc_item_seed(campaign_seed, item);
}

std::uint64_t calc_item_seed(std::uint64_t campaign_seed, std::size_t item) {
  const std::string hash = calc_sha256(fmt::format("seed {} item {}", campaign_seed, item));
  return std::strtoull(hash.substr(0, 14).c_str(), nullptr, 16) >> 3U;
}

/// Writes the number of items of the results file into the progress file, at most once a second, and removes the
/// progress file at the end. Where the results file has no items yet, the first write is after a second.
class ResultsFile::Progress {
 public:
  Progress(std::string path, const Tally& at_start)
      : path_(std::move(path)), next_(std::chrono::steady_clock::now() + kInterval) {
    std::error_code ignored;
    fs::remove(path_, ignored);  // of a process that was killed
    if (at_start.done > 0) say(at_start);
  }
  ~Progress() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void write(const Tally& tally) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kInterval;
    say(tally);
  }

 private:
  static constexpr std::chrono::seconds kInterval{1};

  void say(const Tally& tally) const {
    try {
      write_file_atomically(path_, to_text(Json{{"done", tally.done}, {"failed", tally.failed}}) + "\n");
    } catch (const InputError&) {  // results are worth more than the word on how many there are
    }
  }

  std::string path_;
  std::chrono::steady_clock::time_point next_;
};

ResultsFile::ResultsFile(const std::string& path, const CampaignFolder& folder, const std::vector<bool>& is_elsewhere)
    : store_(path, folder.definition) {
  store_.list_items([&](std::size_t item, bool has_failed) {
    if (item >= is_elsewhere.size() || !is_elsewhere[item]) tally_.add(has_failed);
  });
  progress_ = std::make_unique<Progress>(progress_file_of(path), tally_);
}

ResultsFile::~ResultsFile() = default;

void ResultsFile::list_items(const std::function<void(std::size_t item, bool has_failed)>& visit) const {
  store_.list_items(visit);
}

void ResultsFile::write(const Record& record) {
  store_.write(record);
  tally_.add(!record.failure.empty());
  progress_->write(tally_);
}

void ResultsFile::close() { store_.close(); }

void carry_out_each(const ItemList& list, const CampaignFolder& folder, const std::vector<std::size_t>& items,
                    int threads, const std::function<void(const Record&)>& visit,
                    const std::function<void(double)>& advance) {
  std::size_t finished = 0;
  std::mutex mutex;
  parallel_for(items.size(), threads, [&](std::size_t i) {
    const Record record = carry_out_one(list, folder, items[i]);
    const std::lock_guard<std::mutex> lock(mutex);
    visit(record);
    ++finished;
    if (advance) advance(static_cast<double>(finished) / static_cast<double>(items.size()));
  });
}

void carry_out_all(const ItemList& list, const CampaignFolder& folder, int threads,
                   const std::function<void(const Record&)>& visit, const std::function<void(double)>& advance) {
  std::vector<std::size_t> all(list.count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  carry_out_each(list, folder, all, threads, visit, advance);
}

OpenItems find_open_items(const ItemList& list, const CampaignFolder& folder) {
  DoneItems done(list.count());
  for (const std::string& file : folder.list_files()) done.add(folder, file);
  return {done.list_open({1, 1}), done.count({1, 1})};
}

Tally carry_out_items(const ItemList& list, const CampaignFolder& folder, const Part& part, int threads,
                      const std::function<void(double)>& advance) {
  DoneItems done(list.count());
  done.add_closed(folder, list_files_of_other_divisions(folder, part));
  const std::string path = folder.file_of(part);
  Tally tally = done.count(part);
  if (tally.done == tally.items && !is_there(path)) return tally;
  ResultsFile file(path, folder, done.is_done);
  file.list_items([&](std::size_t item, bool has_failed) { done.add(path, item, has_failed); });
  tally = done.count(part);
  const auto write = [&](const Record& record) {
    file.write(record);
    tally.add(!record.failure.empty());
  };
  carry_out_each(list, folder, done.list_open(part), threads, write, advance);
  file.close();
  return tally;
}

void remove_progress(const std::string& results) {
  std::error_code ignored;
  fs::remove(progress_file_of(results), ignored);
}

FolderState read_state(const CampaignFolder& folder, std::size_t items) {
  FolderState state;
  DoneItems done(items);
  state.running = done.add_closed(folder, folder.list_files());
  state.tally = done.count({1, 1});
  for (const std::string& file : state.running) {
    const Tally said = read_progress(file);
    state.tally.done = std::min(items, state.tally.done + said.done);
    state.tally.failed = std::min(items, state.tally.failed + said.failed);
  }
  return state;
}

}  // namespace rollrig::campaigns
