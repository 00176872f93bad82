#include "sim/core/config.h"

#include <catch2/catch.hpp>

#include "sim/core/schema.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;

namespace {
const char* kText = R"(name = "x"
[table]
number_m = 2.5
whole = 7
list_kPa = [1, 2.5]
flag = true
[[item]]
a = 1
[[item]]
a = 2
)";
}

TEST_CASE("a file that has changed is read anew", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("a.toml");
  for (const double value : {1.0, 2.0, 1.0}) {
    tests::write_file(path, "value = " + std::to_string(value) + "\n");
    const ConfigTable table = read_config(path);
    CHECK(std::get<double>(table.find("value")->data) == value);
    CHECK(table.find("value")->origin.file == path);
  }
  tests::write_file(folder.file("b.toml"), "value = 1.000000\n");  // the same content at another place
  CHECK(read_config(folder.file("b.toml")).find("value")->origin.file == folder.file("b.toml"));
}

TEST_CASE("a config remembers the line of each value", "[fast]") {
  const ConfigTable config = parse_config(kText, "file.toml");
  const ConfigTable& table = *config.find("table")->as_table();
  CHECK(table.find("number_m")->origin.line == 3);
  CHECK(table.find("number_m")->origin.file == "file.toml");
  CHECK(table.origin.line == 2);
}

TEST_CASE("a table reader converts, checks ranges and refuses what nobody asked for", "[fast]") {
  const ConfigTable config = parse_config(kText, "file.toml");
  TableReader file(config, "");
  CHECK(file.text("name") == "x");
  CHECK(file.tables("item").size() == 2);
  TableReader reader(*file.table("table"), "[table]");
  CHECK(reader.number({"number_m", positive(), ""}) == 2.5);
  CHECK(reader.count({"whole", positive(), ""}) == 7);
  CHECK(reader.number({"absent_kPa", positive(), "", 3.0}) == 3000.0);
  CHECK_FALSE(reader.number_or_none({"absent_m", positive(), ""}).has_value());
  CHECK(reader.numbers_or({"list_kPa", positive(), ""}, {}) == std::vector<double>{1000.0, 2500.0});
  CHECK_THROWS_WITH(reader.finish(), Catch::Contains("unknown key 'flag'") && Catch::Contains("line 6"));
  CHECK(reader.flag_or("flag", false));
  CHECK_NOTHROW(reader.finish());
  CHECK_THROWS_WITH(reader.number({"number_m", between(3.0, 4.0), ""}),
                    Catch::Contains("out of range") && Catch::Contains(">= 3 and <= 4") && Catch::Contains("line 3"));
}

TEST_CASE("dotted keys of --set make the tables on their way", "[fast]") {
  ConfigTable config = parse_config(kText, "file.toml");
  set_config_value(config, "table.number_m", "4", "--set");
  set_config_value(config, "new.deep.word", "bare_word", "--set");
  TableReader file(config, "");
  TableReader table(*file.table("table"), "[table]");
  CHECK(table.number({"number_m", positive(), ""}) == 4.0);
  const ConfigTable& deep = *config.find("new")->as_table()->find("deep")->as_table();
  CHECK(std::get<std::string>(deep.find("word")->data) == "bare_word");
  CHECK_THROWS_AS(set_config_value(config, "name.part", "1", "--set"), InputError);
  CHECK_THROWS_AS(set_config_value(config, "a..b", "1", "--set"), InputError);
}

TEST_CASE("a number is read under its old key too, and what a run gives holds under either", "[fast]") {
  const auto read = [](const ConfigTable& config) {
    TableReader reader(config, "");
    const double length_m = reader.number({"length_m", between(0.0, 10.0), "", 7.0, "l_m"});
    reader.finish();
    return length_m;
  };
  CHECK(read(parse_config("l_m = 2", "file.toml")) == 2.0);
  CHECK(read(parse_config("length_m = 2", "file.toml")) == 2.0);
  CHECK(read(parse_config("", "file.toml")) == 7.0);
  for (const auto& [in_file, by_run] : {std::pair{"l_m", "length_m"}, {"length_m", "l_m"}, {"l_m", "l_m"}}) {
    ConfigTable config = parse_config(std::string(in_file) + " = 2", "file.toml");
    set_config_value(config, by_run, "3", "--set");
    CHECK(read(config) == 3.0);
    set_config_value(config, by_run, "11", "--set");
    CHECK_THROWS_WITH(read(config), Catch::Contains(std::string("'") + by_run + "' is out of range"));
  }
  CHECK_THROWS_WITH(read(parse_config("length_m = 2\nl_m = 2", "file.toml")),
                    Catch::Contains("'l_m' and 'length_m' are one number") && Catch::Contains("line 2"));
}

TEST_CASE("the nearest known name is found, and nothing when none is near", "[fast]") {
  const std::vector<std::string> known{"A0_N", "A1_N_s_per_m", "pressure_exponent"};
  CHECK(nearest_name("pressure_exponnet", known) == "pressure_exponent");
  CHECK(nearest_name("a0_n", known) == "A0_N");
  CHECK(nearest_name("zzzzzzzzzz", known).empty());
}

TEST_CASE("a config that is too deep is refused, wherever it is deep", "[fast]") {
  std::string key = "a";
  for (int i = 0; i < 10000; ++i) key += ".a";
  const auto refuses = [](const std::string& text, const char* what) {
    INFO(text.substr(0, 20));
    CHECK_THROWS_WITH(parse_config(text, "file.toml"), Catch::Contains(what) && Catch::Contains("file.toml, line 2"));
  };
  refuses("b = 1\n" + key + " = 1\n", "too many parts");
  refuses("b = 1\n[" + key + "]\n", "too many parts");
  refuses("b = 1\na = " + std::string(5000, '[') + std::string(5000, ']'), "nested too deeply");
  ConfigTable root;
  CHECK_THROWS_WITH(set_config_value(root, key, "1", "command line"), Catch::Contains("too many parts"));
  CHECK_THROWS_WITH(set_config_value(root, "a", std::string(5000, '['), "command line"),
                    Catch::Contains("nested too deeply"));
}

TEST_CASE("a whole number beyond those of the machine is refused", "[fast]") {
  const ConfigTable table = parse_config("small = 2147483647\nlarge = 2147483648\nnegative = -1e300\n", "a.toml");
  TableReader reader(table, "");
  CHECK(reader.count({"small", any_number(), ""}) == 2147483647);
  CHECK_THROWS_AS(reader.count({"large", any_number(), ""}), InputError);
  CHECK_THROWS_AS(reader.count({"negative", any_number(), ""}), InputError);
}
