// Logs of other formats are read as the same columns, and damaged ones are refused.
#include "tables/log_table.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "build_paths.h"
#include "exports/tree.h"
#include "include/rollrig/progress.h"
#include "sim/core/error.h"
#include "tables/hdf5_handle.h"
#include "tables/isolated.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using rollrig::tables::LogTable;
using rollrig::tables::read_log_table;
using rollrig::tests::TemporaryFolder;

namespace {

constexpr std::size_t kRows = 600;

double speed_at(std::size_t row) { return 80.0 + 5.0 * std::sin(0.01 * 0.5 * static_cast<double>(row)); }

/// The log of make_files.py: a row each half second, speed and torque.
void check_log(const std::string& path, const std::string& time, const std::string& speed, const std::string& torque) {
  const LogTable table = read_log_table(path, {}, time);
  REQUIRE(table.rows.row_count() == kRows);
  const std::vector<double> speeds = table.rows.plain_numbers(speed, {});
  const std::vector<double> torques = table.rows.plain_numbers(torque, {});
  double worst = 0.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    worst = std::max(worst, std::abs(speeds[row] - speed_at(row)));
    worst = std::max(worst, std::abs(torques[row] - (40.0 + 0.1 * speed_at(row))));
  }
  CHECK(worst < 1e-5);  // single precision of some
}

/// False, with a warning, where scipy or h5py is not installed.
bool make_files(const TemporaryFolder& folder) {
  const auto made = tests::run_other("/usr/bin/python3",
                                     "'" ROLLRIG_SOURCE_DIR "/tests/tables/make_files.py' '" + folder.path() + "'");
  if (made.status == 77) WARN("python3-scipy or python3-h5py is not installed: nothing is tested");
  if (made.status != 77) REQUIRE(made.status == 0);
  return made.status == 0;
}

exports::Group make_tree() {
  exports::Group recording;
  recording.is_table = true;
  exports::Column time_s, speed_km_h;
  exports::Texts phase;
  for (std::size_t row = 0; row < kRows; ++row) {
    time_s.push_back(0.5 * static_cast<double>(row));
    speed_km_h.push_back(row == 7 ? std::nan("") : speed_at(row));
    phase.push_back(row < 300 ? "warm-up" : "skim");
  }
  recording.add("time_s", {time_s});
  recording.add("speed_km_h", {speed_km_h});
  recording.add("phase", {phase});
  exports::Group tree;
  tree.add("recording", {recording});
  return tree;
}

std::string find_refusal(const std::string& path, const std::string& key) {
  try {
    read_log_table(path, {}, key);
  } catch (const InputError& error) {
    return error.problem().what;
  }
  return "";
}

}  // namespace

TEST_CASE("logs that scipy wrote as .mat are read", "[fast]") {
  const TemporaryFolder folder;
  if (!make_files(folder)) return;
  check_log(folder.file("vectors.mat"), "t", "v", "M");
  check_log(folder.file("packed.mat"), "t", "v", "M");
  check_log(folder.file("records.mat"), "T.t", "T.v", "T.M");
  check_log(folder.file("matrix.mat"), "X.1", "X.2", "X.3");
  check_log(folder.file("stamps.mat"), "stamp", "v", "M");
  check_log(folder.file("struct.mat"), "rig.log.t", "rig.log.v", "rig.log.M");
  const LogTable table = read_log_table(folder.file("struct.mat"), {}, "rig.log.t");
  CHECK(table.units.at("rig.log.v") == "km/h");
  CHECK(read_log_table(folder.file("stamps.mat"), {}, "stamp").rows.text("stamp")[1] == "2024-05-06T10:10:00.500");
  CHECK_FALSE(read_log_table(folder.file("vectors.mat"), {}, "t").rows.has("other"));  // another length
}

TEST_CASE("logs that h5py wrote as HDF5 are read", "[fast]") {
  const TemporaryFolder folder;
  if (!make_files(folder)) return;
  check_log(folder.file("flat.h5"), "t", "v", "M");
  check_log(folder.file("groups.h5"), "run 1/log/t", "run 1/log/v", "run 1/log/M");
  check_log(folder.file("records.h5"), "T/t", "T/v", "T/M");
  check_log(folder.file("matlab73.mat"), "log.t", "log.v", "log.M");
  check_log(folder.file("matrix.h5"), "X.1", "X.2", "X.3");
  const LogTable table = read_log_table(folder.file("groups.h5"), {}, "run 1/log/t");
  CHECK(table.units.at("run 1/log/v") == "km/h");
  for (const char* stamp : {"run 1/log/stamp", "run 1/log/fixed"}) {
    CHECK(table.rows.text(stamp)[1] == "2024-05-06T10:10:00.500");
  }
}

TEST_CASE("what export writes is read with its units and gaps", "[fast]") {
  const TemporaryFolder folder;
  rollrig::tests::write_file(folder.file("a.mat"), exports::make_mat(make_tree()));
  rollrig::tests::write_file(folder.file("a.h5"), exports::make_hdf5(make_tree()));
  for (const auto& [file, dot] : {std::pair("a.mat", "."), std::pair("a.h5", "/")}) {
    const std::string group = std::string("recording") + dot;
    const LogTable table = read_log_table(folder.file(file), {}, group + "time_s");
    REQUIRE(table.rows.row_count() == kRows);
    const std::vector<double> speeds = table.rows.plain_numbers(group + "speed_km_h", {});
    for (std::size_t row = 0; row < kRows; ++row) {
      if (row != 7) CHECK(speeds[row] == speed_at(row));
    }
    CHECK(std::isnan(speeds[7]));
    CHECK(table.units.at(group + "speed_km_h") == "km/h");
    CHECK(table.rows.text(group + "phase")[299] == "warm-up");
    CHECK(table.rows.line_of(299) == 300);
  }
}

TEST_CASE("a small file that unpacks to more than a table may have is refused", "[slow]") {
  const TemporaryFolder folder;
  const std::string file = folder.file("huge.h5");
  {
    using tables::Hdf5Handle;
    const Hdf5Handle to(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const hsize_t rows = 70'000'000;  // 0.56 GB that no byte of the file holds: it is all fill value
    const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
    const Hdf5Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const hsize_t chunk = 1'000'000;
    H5Pset_chunk(how, 1, &chunk);
    for (const char* name : {"a", "b"}) {
      const Hdf5Handle set(H5Dcreate2(to, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
    }
  }
  CHECK(std::filesystem::file_size(file) < 100'000);
  CHECK(find_refusal(file, "a") == "what the file holds is too large");
}

#ifndef ROLLRIG_SANITIZED  // which have no limit
TEST_CASE("a reader that asks for more memory than any table takes is stopped", "[fast]") {
  const auto read_too_much = [](const std::string&) {
    tables::Column column;
    column.values = std::vector<double>(std::size_t{1} << 30);
    return tables::Columns{column};
  };
  CHECK_THROWS_WITH(tables::read_isolated("some.mat", read_too_much), Catch::Contains("is too large"));
}
#endif

TEST_CASE("a reader that does not come to its end is stopped by Ctrl-C, and its process ends", "[fast]") {
  const auto wait_for_long = [](const std::string&) {
    std::this_thread::sleep_for(std::chrono::minutes(5));
    return tables::Columns{};
  };
  const auto start = std::chrono::steady_clock::now();
  const auto before = std::signal(SIGALRM, [](int) { request_interrupt(); });
  ::ualarm(200'000, 0);  // microseconds; the child has no such timer
  CHECK_THROWS_AS(tables::read_isolated("some.mat", wait_for_long), Interrupted);
  std::signal(SIGALRM, before);
  clear_interrupt();
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::minutes(1));
  errno = 0;
  const bool has_child = ::waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD;
  CHECK_FALSE(has_child);
}

TEST_CASE("a column that is not there is named beside those that are", "[fast]") {
  const TemporaryFolder folder;
  rollrig::tests::write_file(folder.file("a.mat"), exports::make_mat(make_tree()));
  CHECK(find_refusal(folder.file("a.mat"), "recording.time") == "missing column 'recording.time'");
  exports::Group none;
  none.add("number", {3.5});
  rollrig::tests::write_file(folder.file("b.mat"), exports::make_mat(none));
  CHECK(find_refusal(folder.file("b.mat"), "t") == "no columns of numbers");
}

TEST_CASE("a file that is cut off anywhere is refused", "[fast]") {
  const TemporaryFolder folder;
  const std::string mat = exports::make_mat(make_tree());
  const std::string hdf5 = exports::make_hdf5(make_tree());
  for (std::size_t part = 1; part < 12; ++part) {
    const auto cut = [part](const std::string& bytes) { return bytes.substr(0, bytes.size() * part / 12); };
    INFO(part << " of 12 parts");
    rollrig::tests::write_file(folder.file("a.mat"), cut(mat));
    CHECK(find_refusal(folder.file("a.mat"), "recording.time_s") == "a damaged .mat file");
    rollrig::tests::write_file(folder.file("a.h5"), cut(hdf5));
    CHECK_THAT(find_refusal(folder.file("a.h5"), "recording/time_s"), Catch::Contains("damaged"));
  }
}
