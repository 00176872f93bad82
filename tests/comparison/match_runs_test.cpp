// Which runs of two sets belong together: by name, else by what they were carried out at.
#include "comparison/match_runs.h"

#include <catch2/catch.hpp>

using rollrig::comparison::match_runs;
using rollrig::measurements::MeasuredRun;
namespace quantities = rollrig::models::quantities;

namespace {

MeasuredRun make_measured(const std::string& id, double speed_m_s, double load_N = 5000.0) {
  MeasuredRun run;
  run.id = id;
  run.initial_tire_temperature_K = 298.0;
  run.cold_pressure_Pa = 250e3;
  for (int row = 0; row < 100; ++row) run.time_s.push_back(row);
  run.columns[quantities::kSpeed].assign(100, speed_m_s);
  run.columns[quantities::kLoad].assign(100, load_N);
  run.columns[quantities::kAmbient].assign(100, 298.0);
  return run;
}

using Matches = std::vector<std::optional<std::size_t>>;

}  // namespace

TEST_CASE("runs of one name belong together in any order, others by their conditions", "[fast]") {
  CHECK(match_runs({make_measured("a", 20.0), make_measured("b", 30.0), make_measured("c", 10.0)},
                   {make_measured("x", 10.1), make_measured("b", 30.0), make_measured("a", 20.0)}) == Matches{2, 1, 0});
}

TEST_CASE("a run that could belong to two others belongs to none", "[fast]") {
  CHECK(match_runs({make_measured("a", 20.0)}, {make_measured("x", 20.1), make_measured("y", 19.9)}) ==
        Matches{std::nullopt});
  CHECK(match_runs({make_measured("a", 20.0), make_measured("b", 20.1)}, {make_measured("x", 20.0)}) ==
        Matches{std::nullopt, std::nullopt});
}

TEST_CASE("runs at another load or speed do not belong together", "[fast]") {
  CHECK(match_runs({make_measured("a", 20.0)}, {make_measured("x", 22.0)}) == Matches{std::nullopt});
  CHECK(match_runs({make_measured("a", 20.0)}, {make_measured("x", 20.0, 5500.0)}) == Matches{std::nullopt});
}
