// Items: each once, whoever carries them out and however often that is interrupted.
#include "campaigns/items.h"

#include <sys/resource.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "campaigns/store.h"
#include "include/rollrig/error.h"
#include "sim/core/file_io.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace rollrig::campaigns;
using rollrig::Json;
using rollrig::tests::TemporaryFolder;

/// 50 items; every ninth fails, and the run is interrupted before `most` of them are done.
class FakeItems : public ItemList {
 public:
  explicit FakeItems(int most = 1000) : most_(most) {}

  std::size_t count() const override { return 50; }
  Json describe(std::size_t item) const override { return {{"x", item}}; }
  Json carry_out(std::size_t item, std::uint64_t seed) const override {
    if (carried_out_++ >= most_) throw rollrig::Interrupted();
    if (item % 9 == 4) throw rollrig::RunFailure("the tire\nburst");
    return {{"square", item * item}, {"seed", seed}};
  }

  int count_carried_out() const { return carried_out_; }

 private:
  int most_;
  mutable std::atomic<int> carried_out_{0};
};

/// While the object exists, this process can write nothing into files, as on a full disk.
class NoRoomForFiles {
 public:
  NoRoomForFiles() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none{0, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
  ~NoRoomForFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  NoRoomForFiles(const NoRoomForFiles&) = delete;
  NoRoomForFiles& operator=(const NoRoomForFiles&) = delete;

 private:
  using Handler = void (*)(int);
  rlimit before_{};
  Handler handler_;
};

/// All records as one text.
std::string read_all(const CampaignFolder& folder) {
  std::string text;
  read_records(folder.list_files(), folder.definition, [&text](const Record& record) {
    text += std::to_string(record.item) + " " + record.identity + " " + std::to_string(record.seed) + " " +
            record.result + " " + record.failure + "\n";
  });
  return text;
}

std::string read_undisturbed() {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  carry_out_items(FakeItems(), folder, {1, 1}, 1);
  return read_all(folder);
}

}  // namespace

TEST_CASE("every item is carried out once, and a failure is its result", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  const FakeItems list;
  const Tally tally = carry_out_items(list, folder, {1, 1}, 2);
  CHECK(tally.items == 50);
  CHECK(tally.done == 50);
  CHECK(tally.failed == 6);
  const std::string all = read_all(folder);
  CHECK(all == read_undisturbed());  // that of one thread
  CHECK_THAT(all, Catch::Contains("the tire; burst"));
  carry_out_items(list, folder, {1, 1}, 2);
  CHECK(list.count_carried_out() == 50);
}

TEST_CASE("parts, interruptions and other splits come to the same results", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  for (const int most : {5, 1, 0, 8}) {
    CHECK_THROWS_AS(carry_out_items(FakeItems(most), folder, {2, 3}, 2), rollrig::Interrupted);
  }
  const FolderState state = read_state(folder, 50);
  CHECK(state.tally.done >= 10);  // 14, but for those that two threads had begun
  CHECK(state.tally.done <= 14);
  carry_out_items(FakeItems(), folder, {1, 3}, 2);
  const FakeItems rest;
  carry_out_items(rest, folder, {1, 1}, 2);
  CHECK(rest.count_carried_out() <= 50 - 17 - 10);
  CHECK(read_all(folder) == read_undisturbed());
  CHECK(read_state(folder, 50).tally.done == 50);
}

/// Items of a grid; it remembers their order.
class OrderedItems : public ItemList {
 public:
  explicit OrderedItems(std::size_t items) : items_(items) {}
  std::size_t count() const override { return items_; }
  Json describe(std::size_t item) const override { return {{"x", item}}; }
  Json carry_out(std::size_t item, std::uint64_t) const override {
    order_.push_back(item);
    return {{"x", item}};
  }
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  std::size_t items_;
  mutable std::vector<std::size_t> order_;
};

TEST_CASE("a tenth of the work tells the time of the rest, whatever factor of a grid it depends on", "[fast]") {
  struct Grid {
    std::size_t outer, values, inner;  // the time of an item depends on the middle one: from 1 to 10 times the least
    Part part = {};
  };
  for (const Grid& grid : {Grid{5, 20, 1}, Grid{13, 50, 1, {2, 3}}, Grid{4, 5, 21}, Grid{20, 16, 1}, Grid{1, 16, 20},
                           Grid{10, 20, 1}, Grid{1, 20, 10}, Grid{50, 32, 1, {2, 3}}, Grid{30, 7, 9}}) {
    INFO(grid.outer << " x " << grid.values << " x " << grid.inner);
    const TemporaryFolder at;
    const OrderedItems list(grid.outer * grid.values * grid.inner);
    carry_out_items(list, {at.path(), "test", 11}, grid.part, 1);
    REQUIRE(list.order().size() == grid.part.count_of(list.count()));
    CHECK(std::set<std::size_t>(list.order().begin(), list.order().end()).size() == list.order().size());
    const auto calc_time = [&grid](std::size_t item) {
      const std::size_t value = item / grid.inner % grid.values;
      return 1.0 + 9.0 * static_cast<double>(value) / static_cast<double>(grid.values - 1);
    };
    double whole = 0.0;
    for (const std::size_t item : list.order()) whole += calc_time(item);
    double done = 0.0;
    std::size_t items = 0;
    while (done < 0.1 * whole) done += calc_time(list.order()[items++]);
    const double share = static_cast<double>(items) / static_cast<double>(list.order().size());
    const double told = done * (1.0 - share) / share;  // as the line of progress has it
    CHECK(told == Approx(whole - done).epsilon(0.2));
  }
}

TEST_CASE("each part of a grid has all values of its last factor, also where there are as many as parts", "[fast]") {
  for (std::size_t number = 1; number <= 10; ++number) {
    std::set<std::size_t> values;
    const Part part{number, 10};
    for (std::size_t item = 0; item < 1000; ++item) {
      if (part.has(item)) values.insert(item % 10);
    }
    CHECK(values.size() == 10);
  }
}

TEST_CASE("a results file does not grow with what defines the campaign", "[fast]") {
  const TemporaryFolder at;
  const std::string definition(1000000, 'x');
  const std::string told = rollrig::calc_sha256(definition);
  { const Store older(at.file("results_0001_of_0002.sqlite"), definition); }  // as files had it
  const CampaignFolder folder{at.path(), told, 11};
  carry_out_items(FakeItems(), folder, {1, 2}, 1);
  carry_out_items(FakeItems(), folder, {2, 2}, 1);
  CHECK(std::filesystem::file_size(folder.file_of({2, 2})) < 100000);
  CHECK(read_state(folder, 50).tally.done == 50);
}

TEST_CASE("one process alone writes a file", "[slow]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  const Store store(folder.file_of({1, 2}), "test");
  CHECK(list_in_use({folder.file_of({1, 2}), folder.file_of({2, 2})}) ==
        std::vector<std::string>{folder.file_of({1, 2})});
  CHECK_THROWS_AS(Store(folder.file_of({1, 2}), "test"), rollrig::InputError);
  CHECK_THROWS_AS(carry_out_items(FakeItems(), folder, {1, 2}, 1), rollrig::InputError);
  carry_out_items(FakeItems(), folder, {2, 2}, 1);
  const FolderState state = read_state(folder, 50);
  CHECK(state.tally.done == 25);
  CHECK(state.running.size() == 1);
}

TEST_CASE("many files that are written are looked at in the time of one", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  std::vector<std::unique_ptr<Store>> stores;
  for (std::size_t number = 1; number <= 10; ++number) {
    stores.push_back(std::make_unique<Store>(folder.file_of({number, 10}), "test"));
  }
  const auto start = std::chrono::steady_clock::now();
  CHECK(read_state(folder, 50).running.size() == 10);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));  // 10 x 0.2 s if one after the other
}

TEST_CASE("items that two files have count once, also while one of them is written", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  const FakeItems list;
  carry_out_items(list, folder, {1, 2}, 1);
  const std::string part = folder.file_of({1, 2});
  // As where a merge was killed after it had renamed its file and before it removed those of the parts.
  std::filesystem::copy_file(part, at.file("results.sqlite"));
  std::vector<bool> is_merged(50);
  read_items(part, "test", [&](std::size_t item, bool) { is_merged[item] = true; });
  ResultsFile file(part, folder, is_merged);
  file.write({1, "identity", 1, "{}", ""});
  const FolderState state = read_state(folder, 50);
  CHECK(state.running.size() == 1);
  CHECK(state.tally.done >= 25);
  CHECK(state.tally.done <= 26);  // what the process tells is up to a second old
}

TEST_CASE("results of another campaign and damaged files are refused", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  carry_out_items(FakeItems(), folder, {1, 2}, 1);
  CHECK_THROWS_AS(carry_out_items(FakeItems(), {at.path(), "other", 11}, {1, 1}, 1), rollrig::InputError);
  std::ofstream(folder.file_of({2, 2})) << "no database, but a text that is longer than a header";
  CHECK_THROWS_AS(read_state(folder, 50), rollrig::InputError);
}

TEST_CASE("two files that contradict each other are refused", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  Store(folder.file_of({1, 2}), "test").write({3, "identity", 1, "{\"x\":1}", ""});
  Store(folder.file_of({2, 2}), "test").write({3, "identity", 1, "{\"x\":1}", ""});
  CHECK(read_all(folder) == "3 identity 1 {\"x\":1} \n");
  Store(folder.file_of({1, 3}), "test").write({3, "identity", 1, "{\"x\":2}", ""});
  CHECK_THROWS_AS(read_all(folder), rollrig::InputError);
}

TEST_CASE("results of items that no campaign has are refused at once", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  Store(folder.file_of({1, 1}), "test").write({std::size_t{1} << 62U, "identity", 1, "{}", ""});
  CHECK_THROWS_AS(read_all(folder), rollrig::InputError);
  CHECK_THROWS_AS(read_state(folder, 50), rollrig::InputError);
}

TEST_CASE("files of others are neither adopted nor removed", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  Store(at.file("notes.sqlite"), "another use").write({3, "identity", 1, "{}", ""});
  Store(folder.file_of({1, 1}), "another use").write({3, "identity", 1, "{}", ""});
  CHECK(folder.list_files().size() == 1);
  CHECK_THROWS_AS(Store(folder.file_of({1, 1}), "test"), rollrig::InputError);
  CHECK_THROWS_AS(remove_if_contained(folder.file_of({1, 1}), "test", [](std::size_t) { return true; }),
                  rollrig::InputError);
  CHECK(folder.list_files().size() == 1);
}

TEST_CASE("items have seeds of their own, which no split changes", "[fast]") {
  CHECK(calc_item_seed(1, 0) != calc_item_seed(1, 1));
  CHECK(calc_item_seed(1, 0) != calc_item_seed(2, 0));
  std::set<std::uint64_t> seeds;
  for (std::size_t item = 0; item < 100000; ++item) seeds.insert(calc_item_seed(1, item));
  CHECK(seeds.size() == 100000);
  CHECK(*seeds.rbegin() < (std::uint64_t{1} << 53U));
}

TEST_CASE("a file of a process that was killed as it made it is empty", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  std::ofstream(folder.file_of({1, 1})).flush();
  CHECK(read_state(folder, 50).tally.done == 0);
  CHECK(carry_out_items(FakeItems(), folder, {1, 1}, 1).done == 50);
  CHECK(read_all(folder) == read_undisturbed());
}

TEST_CASE("a file of a process that was killed as it closed it is read, and its mark of a log goes", "[fast]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  carry_out_items(FakeItems(), folder, {1, 1}, 1);
  const std::string path = folder.file_of({1, 1});
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(18);
    file.write("\x02\x02", 2);  // read and write version of SQLite: with a log
  }
  CHECK(read_all(folder) == read_undisturbed());
  std::ifstream file(path, std::ios::binary);
  file.seekg(18);
  CHECK(file.get() == 1);
  CHECK(!std::filesystem::exists(path + "-wal"));
  CHECK(!std::filesystem::exists(path + "-shm"));
}

TEST_CASE("where the disk is full, what a killed process has left is counted, and stays", "[fast]") {
  const TemporaryFolder at;
  const TemporaryFolder killed;
  const CampaignFolder folder{killed.path(), "test", 11};
  const std::string path = folder.file_of({1, 1});
  {
    const std::string written = at.file("results_0001_of_0001.sqlite");
    Store store(written, "test");
    store.write({3, "identity", 1, "{}", ""});
    store.write({4, "identity", 1, "", "failed"});
    for (const char* end : {"", "-wal"}) std::filesystem::copy_file(written + end, path + end);
  }
  const auto log_bytes = std::filesystem::file_size(path + "-wal");
  CHECK(log_bytes > 0);
  {
    const NoRoomForFiles full;
    const FolderState state = read_state(folder, 50);
    CHECK(state.tally.done == 2);
    CHECK(state.tally.failed == 1);
    CHECK(state.running.empty());
    CHECK_THROWS_AS(Store(path, "test").write({5, "identity", 1, "{}", ""}), rollrig::InputError);
  }
  CHECK(std::filesystem::file_size(path + "-wal") >= log_bytes);
  CHECK(read_state(folder, 50).tally.done == 2);
  CHECK(!std::filesystem::exists(path + "-wal"));
}

TEST_CASE("a file that has a further item is not removed", "[slow]") {
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  const std::string file = folder.file_of({1, 1});
  carry_out_items(FakeItems(), folder, {1, 1}, 1);
  remove_if_contained(file, "test", [](std::size_t item) { return item != 30; });
  CHECK(folder.list_files().size() == 1);
  {
    const Store writer(file, "test");
    CHECK_THROWS_AS(remove_if_contained(file, "test", [](std::size_t) { return true; }), rollrig::InputError);
  }
  remove_if_contained(file, "test", [](std::size_t) { return true; });
  CHECK(folder.list_files().empty());
}

TEST_CASE("items stop where what they are made from changes", "[fast]") {
  class Changing : public FakeItems {
   public:
    void require_unchanged() const override {
      if (count_carried_out() > 10) throw CampaignChanged({"the file has changed", "tire.toml", 0, "", "", "", ""});
    }
  };
  const TemporaryFolder at;
  const CampaignFolder folder{at.path(), "test", 11};
  CHECK_THROWS_AS(carry_out_items(Changing(), folder, {1, 1}, 1), CampaignChanged);
  CHECK(read_state(folder, 50).tally.done == 10);
}
