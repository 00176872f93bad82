// The C API, and the examples that use it.
#include "rollrig/c_api.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "build_paths.h"
#include "rollrig/run.h"
#include "tests/support/run_program.h"

using rollrig::tests::ProgramResult;

namespace {

struct FreeC {
  void operator()(rollrig_wheel* wheel) const { rollrig_wheel_free(wheel); }
  void operator()(rollrig_run* run) const { rollrig_run_free(run); }
};
using WheelPointer = std::unique_ptr<rollrig_wheel, FreeC>;
using RunPointer = std::unique_ptr<rollrig_run, FreeC>;

double get(const WheelPointer& wheel, const char* name) {
  double value = 0.0;
  REQUIRE(rollrig_wheel_get(wheel.get(), rollrig_wheel_find_variable(wheel.get(), name), &value) == ROLLRIG_OK);
  return value;
}

void set(const WheelPointer& wheel, const char* name, double value) {
  REQUIRE(rollrig_wheel_set(wheel.get(), rollrig_wheel_find_variable(wheel.get(), name), value) == ROLLRIG_OK);
}

}  // namespace

TEST_CASE("a wheel of the C API warms up, is kept and goes on", "[fast]") {
  CHECK(rollrig_c_api_version() == ROLLRIG_C_API_VERSION);
  const WheelPointer tire(rollrig_wheel_create("a50", "drum_2m"));
  REQUIRE(tire != nullptr);
  set(tire, "thermal.gas_heat_capacity_J_per_K", 80.0);
  REQUIRE(rollrig_wheel_start(tire.get(), 0.0) == ROLLRIG_OK);
  set(tire, "speed_m_s", 20.0);
  const double cold_N = get(tire, "rolling_resistance_N");
  REQUIRE(rollrig_wheel_step(tire.get(), 900.0) == ROLLRIG_OK);
  CHECK(get(tire, "rolling_resistance_N") < 0.95 * cold_N);
  std::vector<char> bytes(static_cast<std::size_t>(rollrig_wheel_saved_size(tire.get())));
  REQUIRE(rollrig_wheel_save(tire.get(), bytes.data(), static_cast<int>(bytes.size())) == ROLLRIG_OK);
  REQUIRE(rollrig_wheel_step(tire.get(), 60.0) == ROLLRIG_OK);

  // The same tire, given as the text of its file.
  const std::string text = rollrig::tests::read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml");
  const WheelPointer other(rollrig_wheel_create(text.c_str(), "drum_2m"));
  REQUIRE(other != nullptr);
  REQUIRE(rollrig_wheel_load(other.get(), bytes.data(), static_cast<int>(bytes.size())) == ROLLRIG_OK);
  REQUIRE(rollrig_wheel_step(other.get(), 60.0) == ROLLRIG_OK);
  CHECK(get(other, "liner_temperature_K") == get(tire, "liner_temperature_K"));

  // Another tire, another rig, and bytes of which one is another.
  const int size = static_cast<int>(bytes.size());
  for (const auto& [name, rig] : {std::pair("a60", "drum_2m"), std::pair("a50", "road")}) {
    const WheelPointer strange(rollrig_wheel_create(name, rig));
    CHECK(rollrig_wheel_load(strange.get(), bytes.data(), size) == ROLLRIG_INPUT_ERROR);
    CHECK_THAT(rollrig_last_error(), Catch::Contains("another wheel"));
  }
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    CHECK(rollrig_wheel_load(other.get(), bytes.data(), size) == ROLLRIG_INPUT_ERROR);
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
  }
}

TEST_CASE("a solver of one's own finds states, rates and derivatives in the C API", "[fast]") {
  const WheelPointer tire(rollrig_wheel_create("a50", "road"));
  REQUIRE(rollrig_wheel_start(tire.get(), 0.0) == ROLLRIG_OK);
  set(tire, "speed_m_s", 20.0);
  const int count = rollrig_wheel_state_count(tire.get());
  REQUIRE(count >= 3);
  std::vector<double> states(static_cast<std::size_t>(count));
  std::vector<double> rates(states.size());
  REQUIRE(rollrig_wheel_get_states(tire.get(), states.data(), count) == ROLLRIG_OK);
  REQUIRE(rollrig_wheel_get_rates(tire.get(), rates.data(), count) == ROLLRIG_OK);
  CHECK(rates.back() == Approx(20.0 * get(tire, "rolling_resistance_N")));  // of the energy that is lost
  states.front() += 10.0;
  REQUIRE(rollrig_wheel_set_states(tire.get(), states.data(), count) == ROLLRIG_OK);
  CHECK(get(tire, "liner_temperature_K") == Approx(states.front()));
  const int known = rollrig_wheel_find_variable(tire.get(), "load_N");
  const int unknown = rollrig_wheel_find_variable(tire.get(), "rolling_resistance_N");
  const double one = 1.0;
  double derivative = 0.0;
  REQUIRE(rollrig_wheel_differentiate(tire.get(), &unknown, 1, &known, 1, &one, &derivative) == ROLLRIG_OK);
  CHECK(derivative > 0.0);
  CHECK(rollrig_wheel_variable_role(tire.get(), known) == std::string("input"));
}

TEST_CASE("the C API says what is wrong", "[fast]") {
  CHECK(rollrig_wheel_create("a5", "road") == nullptr);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("a50"));
  CHECK(rollrig_wheel_create(nullptr, nullptr) == nullptr);
  CHECK(rollrig_wheel_create("not = a tire\n", "road") == nullptr);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("text of tires"));
  const WheelPointer tire(rollrig_wheel_create("a50", "road"));
  CHECK(rollrig_wheel_step(tire.get(), 1.0) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_find_variable(tire.get(), "speed") == -1);
  CHECK(rollrig_wheel_set(tire.get(), -1, 1.0) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_set(tire.get(), 0, std::numeric_limits<double>::quiet_NaN()) == ROLLRIG_INPUT_ERROR);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("speed_m_s"));
  CHECK(rollrig_wheel_variable_name(tire.get(), 100000) == nullptr);
  CHECK(rollrig_wheel_find_variable(nullptr, "speed_m_s") == -1);
  CHECK(rollrig_wheel_state_count(nullptr) == 0);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("speed_m_s"));  // what needs no status sets no error
  CHECK(rollrig_wheel_get(nullptr, 0, nullptr) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_load(tire.get(), "abc", 3) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_load(tire.get(), "abc", -3) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_start(tire.get(), 1e14) == ROLLRIG_INPUT_ERROR);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("-1e+10 to 1e+10 s"));
  REQUIRE(rollrig_wheel_start(tire.get(), 0.0) == ROLLRIG_OK);
  int load = rollrig_wheel_find_variable(tire.get(), "load_N");
  double one = 1.0;
  CHECK(rollrig_wheel_differentiate(tire.get(), &load, -1, &load, 1, &one, &one) == ROLLRIG_INPUT_ERROR);
  CHECK(rollrig_wheel_differentiate(tire.get(), &load, 1, &load, -1, &one, &one) == ROLLRIG_INPUT_ERROR);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("-1"));
  CHECK(rollrig_wheel_get_states(tire.get(), &one, -1) == ROLLRIG_INPUT_ERROR);
  rollrig_wheel_free(nullptr);
  rollrig_run_free(nullptr);
  CHECK(rollrig_run_carry_out("{\"scenari\": \"warm_up\"}") == nullptr);
  CHECK_THAT(rollrig_last_error(), Catch::Contains("scenario"));
  CHECK(rollrig_run_carry_out("[") == nullptr);
  for (const char* input : {"{\"scenario\": \"warm_up\", \"tire\": \"a50\\u0000b\"}",
                            "{\"scenario\": \"warm_up\", \"settings\": {\"program\": \"a\\u0000b\"}}"}) {
    CHECK(rollrig_run_carry_out(input) == nullptr);
    CHECK_THAT(rollrig_last_error(), Catch::Contains("NUL character"));
  }
  CHECK(rollrig_run_carry_out(nullptr) == nullptr);
  CHECK(rollrig_run_carry_out("{\"scenario\": \"warm_up\", \"tire\": 5}") == nullptr);
  CHECK(rollrig_run_carry_out("{\"scenario\": \"warm_up\", \"settings\": [1]}") == nullptr);
  CHECK(rollrig_run_json(nullptr) == nullptr);
}

TEST_CASE("the C API says what is wrong with the JSON of a run, which is in no file", "[fast]") {
  const std::vector<std::array<const char*, 2>> cases{
      {"{\"scenario\": \"warm_up\",\n \"tire\" \"a50\"}",
       "the input of a run cannot be read: not JSON (line 2 of the text)"},
      {"{\"scenario\": \"warm_up\", \"seed\": 1e999}", "a number that is too large"},
      {"[1, 2]", "the input of a run is JSON, but no object"},
      {"{\"scenario\": \"warm_up\", \"settings\": []}", "'settings' must be an object"},
      {"{\"scenario\": \"warm_up\", \"settings\": \"speed_km_h=80\"}", "'settings' must be an object"},
      {"{\"scenario\": \"warm_up\", \"tire\": {\"thermal\": {}}}", "'tire' must be a text"},
      {"{\"scenario\": 5}", "'scenario' must be a text"},
      {"{\"scenario\": \"warm_up\", \"tire\": \"a50\", \"settings\": {\"effects\": {\"slow_laek\": {}}}}", "slow_leak"},
      {"{\"scenario\": \"warm_up\", \"tire\": \"a50\", \"settings\": {\"effects\": [\"slow_leak\"]}}",
       "'effects' must be an object"}};
  for (const auto& [input, said] : cases) {
    INFO(input);
    CHECK(rollrig_run_carry_out(input) == nullptr);
    const std::string error = rollrig_last_error();
    CHECK_THAT(error, Catch::Contains(said) && !Catch::Contains("member of a run") && !Catch::Contains("file as"));
    CHECK_THAT(error, !Catch::Contains("where    input"));
  }
}

TEST_CASE("objects in the settings of a run of the C API stand for names with a dot", "[fast]") {
  const std::string run = R"({"scenario": "warm_up", "tire": "a50", "fidelity": "quasi_static", "rig": null, )";
  const auto carry_out = [&run](const std::string& settings) {
    const RunPointer done(rollrig_run_carry_out((run + R"("settings": {"warm_up_min": 5)" + settings + "}}").c_str()));
    INFO(rollrig_last_error());
    REQUIRE(done != nullptr);
    return std::string(rollrig_run_json(done.get()));
  };
  const std::string nested =
      carry_out(R"(, "effects": {"slow_leak": {}, "bearing_warmup": {"fall_per_K": 0.02}}, "ambient_degC": null)");
  CHECK(nested == carry_out(R"(, "effects.slow_leak": {}, "effects.bearing_warmup.fall_per_K": 0.02)"));
  CHECK(nested != carry_out(""));
  CHECK(carry_out(R"(, "effects": {})") == carry_out(""));
}

TEST_CASE("each thread has the last error of its own calls", "[fast]") {
  const WheelPointer tire(rollrig_wheel_create("a50", "road"));
  CHECK(rollrig_wheel_step(tire.get(), 1.0) == ROLLRIG_INPUT_ERROR);
  const std::string mine = rollrig_last_error();
  CHECK_FALSE(mine.empty());
  std::string before = "unset";
  std::string after;
  std::thread other([&] {
    before = rollrig_last_error();
    const WheelPointer strange(rollrig_wheel_create("no_such_tire", "road"));
    after = rollrig_last_error();
  });
  other.join();
  CHECK(before.empty());
  CHECK_THAT(after, Catch::Contains("no_such_tire"));
  CHECK(rollrig_last_error() == mine);
  CHECK(rollrig_wheel_start(tire.get(), 0.0) == ROLLRIG_OK);
  CHECK(rollrig_last_error() == std::string());
}

TEST_CASE("a hundred thousand random calls of the C API crash nothing and leave a wheel that works", "[slow]") {
  const WheelPointer tire(rollrig_wheel_create("a50", "drum_2m"));
  std::mt19937 random(5);
  const auto pick = [&random](std::size_t count) { return static_cast<int>(random() % count); };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double numbers[] = {NAN, kNone, -kNone, 0.0, -1.0, 1.0, 0.1, 25.0, 300.0, 5000.0, 1e300, 1e-300, 1e11};
  const auto number = [&] { return numbers[pick(std::size(numbers))]; };
  const int variables = rollrig_wheel_variable_count(tire.get());
  const int states = rollrig_wheel_state_count(tire.get());
  std::vector<char> bytes(1);
  int counts[4] = {};  // by status; 3 is ROLLRIG_RUN_FAILED
  for (int call = 0; call < 100000; ++call) {
    rollrig_wheel* wheel = pick(50) == 0 ? nullptr : tire.get();
    double values[16];
    int indices[4];
    for (double& value : values) value = pick(2) == 0 ? 300.0 : number();
    for (int& index : indices) index = pick(static_cast<std::size_t>(variables) + 4) - 2;
    double* given = pick(20) == 0 ? nullptr : values;
    const int count = pick(2) == 0 ? states : pick(8) - 1;
    int status = ROLLRIG_OK;
    switch (pick(13)) {
      case 0:
      case 1:
        status = rollrig_wheel_set(wheel, indices[0], number());
        break;
      case 2:
        status = rollrig_wheel_get(wheel, indices[0], given);
        break;
      case 3:
        status = rollrig_wheel_set_slope(wheel, indices[0], number());
        break;
      case 4:
        if (pick(10) == 0) status = rollrig_wheel_start(wheel, number());
        break;
      case 5:
        status = rollrig_wheel_step(wheel, number());
        break;
      case 6:
        if (pick(40) == 0) status = rollrig_wheel_reset(wheel);
        break;
      case 7:
        status = rollrig_wheel_get_states(wheel, given, count);
        break;
      case 8:
        status = rollrig_wheel_set_states(wheel, given, count);
        break;
      case 9:
        status = rollrig_wheel_get_rates(wheel, given, count);
        break;
      case 10:
        status = rollrig_wheel_differentiate(wheel, pick(20) == 0 ? nullptr : indices, pick(6) - 1, indices,
                                             pick(6) - 1, given, pick(20) == 0 ? nullptr : values + 4);
        break;
      case 11:
        bytes.resize(static_cast<std::size_t>(rollrig_wheel_saved_size(tire.get())));
        status =
            rollrig_wheel_save(wheel, pick(20) == 0 ? nullptr : bytes.data(), static_cast<int>(bytes.size()) - pick(2));
        break;
      default: {
        if (pick(2) == 0) bytes[static_cast<std::size_t>(pick(bytes.size()))] = static_cast<char>(random());
        const auto whole = static_cast<int>(bytes.size());
        const int size = pick(5) == 0 ? std::min(whole, pick(200) - 50) : whole;  // never more than there are
        status = rollrig_wheel_load(wheel, pick(20) == 0 ? nullptr : bytes.data(), size);
      }
    }
    REQUIRE((status == ROLLRIG_OK || status == ROLLRIG_INPUT_ERROR || status == ROLLRIG_RUN_FAILED));
    REQUIRE((status == ROLLRIG_OK || *rollrig_last_error() != '\0'));
    if (wheel == nullptr && status == ROLLRIG_OK) continue;  // one that was not made
    ++counts[status];
  }
  CHECK(counts[ROLLRIG_OK] > 10000);
  CHECK(counts[ROLLRIG_INPUT_ERROR] > 10000);
  REQUIRE(rollrig_wheel_reset(tire.get()) == ROLLRIG_OK);
  const WheelPointer fresh(rollrig_wheel_create("a50", "drum_2m"));
  for (const WheelPointer* one : {&tire, &fresh}) {
    REQUIRE(rollrig_wheel_start(one->get(), 0.0) == ROLLRIG_OK);
    set(*one, "speed_m_s", 20.0);
    REQUIRE(rollrig_wheel_step(one->get(), 60.0) == ROLLRIG_OK);
  }
  CHECK(get(tire, "liner_temperature_K") == get(fresh, "liner_temperature_K"));
}

TEST_CASE("wheels and runs of the C API in threads give what they give alone", "[fast]") {
  const char* input = R"({"scenario": "warm_up", "tire": "a50", "fidelity": "quasi_static"})";
  const auto work = [input](std::string& found) {
    const WheelPointer tire(rollrig_wheel_create("a50", "road"));
    const int speed = rollrig_wheel_find_variable(tire.get(), "speed_m_s");
    const int liner = rollrig_wheel_find_variable(tire.get(), "liner_temperature_K");
    bool is_good = rollrig_wheel_start(tire.get(), 0.0) == ROLLRIG_OK;
    for (int i = 0; i < 200; ++i) {
      is_good = is_good && rollrig_wheel_set(tire.get(), speed, 10.0 + 0.1 * i) == ROLLRIG_OK;
      is_good = is_good && rollrig_wheel_step(tire.get(), 1.0) == ROLLRIG_OK;
    }
    double liner_K = 0.0;
    is_good = is_good && rollrig_wheel_get(tire.get(), liner, &liner_K) == ROLLRIG_OK;
    const RunPointer run(rollrig_run_carry_out(input));
    if (is_good && run != nullptr) found = std::to_string(liner_K) + rollrig_run_json(run.get());
  };
  std::string alone;
  work(alone);
  REQUIRE_FALSE(alone.empty());
  std::vector<std::string> found(8);
  std::vector<std::thread> threads;
  for (std::string& each : found) threads.emplace_back([&work, &each] { work(each); });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& each : found) CHECK((each == alone));
}

TEST_CASE("a whole test by the C API is that of the program", "[fast]") {
  const RunPointer run(rollrig_run_carry_out(R"({"scenario": "warm_up", "tire": "a50", "fidelity": "quasi_static",
                                                 "settings": {"speed_km_h": 100}})"));
  INFO(rollrig_last_error());
  REQUIRE(run != nullptr);
  const rollrig::RunResult expected =
      rollrig::Run({"warm_up", "a50", "", "", "quasi_static", "", "", "", {"speed_km_h=100"}}).carry_out();
  CHECK(rollrig_run_json(run.get()) == expected.json);
  const rollrig::Recording recording = expected.make_recording();
  REQUIRE(rollrig_run_row_count(run.get()) == static_cast<int>(recording.time_s.size()));
  REQUIRE(rollrig_run_channel_count(run.get()) == static_cast<int>(recording.channels.size()) + 1);
  CHECK(rollrig_run_channel_name(run.get(), 0) == std::string("time_s"));
  std::vector<double> values(recording.time_s.size());
  REQUIRE(rollrig_run_get_channel(run.get(), 1, values.data(), static_cast<int>(values.size())) == ROLLRIG_OK);
  CHECK(values == recording.channels.front().values);
  CHECK(rollrig_run_get_channel(run.get(), 1, values.data(), 1) == ROLLRIG_INPUT_ERROR);
}

#ifdef ROLLRIG_EXAMPLE_WARM_TIRE
TEST_CASE("the examples in C and Python warm the same tire", "[fast]") {
  const ProgramResult c = rollrig::tests::run_other(ROLLRIG_EXAMPLE_WARM_TIRE, "");
  INFO(c.err);
  REQUIRE(c.status == 0);
  CHECK_THAT(c.out, Catch::Contains("min  resistance N"));
#ifndef ROLLRIG_SANITIZED  // Python does not bring their library
  const std::string script = std::string(ROLLRIG_SOURCE_DIR) + "/examples/warm_tire.py ";
  const ProgramResult python = rollrig::tests::run_other("/usr/bin/python3", script + ROLLRIG_LIBRARY);
  INFO(python.err);
  REQUIRE(python.status == 0);
  CHECK(python.out == c.out);
#endif
}
#endif
