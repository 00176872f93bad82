// What the command line says of itself, of wrong words and of runs that fail.
#include <catch2/catch.hpp>

#include "build_paths.h"
#include "tests/cli/longest_line.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using rollrig::tests::longest_line;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

TEST_CASE("describe explains scenarios, effects and assets within 80 columns", "[fast]") {
  for (const char* name : {"iso_28580", "warm_up", "skim", "skim_series", "transient_skim", "load_sweep",
                           "pressure_sweep", "speed_sweep", "load_exponent", "bearing_warmup", "tire_loss_in_skim"}) {
    const auto run = run_program(std::string("describe ") + name);
    INFO(name);
    CHECK(run.status == 0);
    CHECK(longest_line(run.out) <= 80);
    CHECK_THAT(run.out, Contains("Source"));
  }
  CHECK_THAT(run_program("describe a50").out, Contains("Table 3.1"));
  CHECK(longest_line(run_program("list").out) <= 80);
  const auto typo = run_program("describe iso_28850");
  CHECK(typo.status == 2);
  CHECK_THAT(typo.err, Contains("iso_28580"));
}

TEST_CASE("help stands everywhere", "[fast]") {
  for (const char* command : {"", "run", "sweep", "regress", "validate", "list", "describe", "fit", "fit tire",
                              "fit road-load", "diagnose", "export", "serve", "completion", "man"}) {
    const auto run = run_program(std::string(command) + " --help");
    INFO(command);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains("Usage"));
    CHECK(longest_line(run.out) <= 80);
  }
  CHECK_THAT(run_program("--help").out, Contains("--log debug|info|warning|error|off\n"));
  CHECK_THAT(run_program("man").out, Contains("debug|info|warning|error|off"));
  CHECK_THAT(run_program("fit road-load --help").out, Contains("--mass FLOAT in [100 - 1e+06]\n"));
}

TEST_CASE("help is a command as well, a list may be of one kind, and a file of one's own is described", "[fast]") {
  CHECK(run_program("help").out == run_program("--help").out);
  CHECK(run_program("help fit tire").out == run_program("fit tire --help").out);
  const auto no_command = run_program("help fit tyre");
  CHECK(no_command.status == 2);
  CHECK_THAT(no_command.err, Contains("nearest  tire"));
  const auto tires = run_program("list tires");
  CHECK_THAT(tires.out, Contains("a50") && !Contains("iso_28580") && !Contains("rigs"));
  CHECK_THAT(run_program("list effects").out, Contains("bearing_warmup") && !Contains("a50"));
  const auto no_kind = run_program("list tire");
  CHECK(no_kind.status == 2);
  CHECK_THAT(no_kind.err, Contains("nearest  tires"));
  const TemporaryFolder folder;
  write_file(folder.file("own.toml"), read_file(ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml"));
  CHECK_THAT(run_program("describe own.toml", folder.path()).out, Contains("tire 'a50'") && Contains("Table 3.1"));
  const auto no_file = run_program("describe nowhere.toml", folder.path());
  CHECK(no_file.status == 2);
  CHECK_THAT(no_file.err, Contains("nowhere.toml"));
}

TEST_CASE("usage errors name the nearest word and exit with 2", "[fast]") {
  const auto option = run_program("run iso_28580 --tyre a50");
  CHECK(option.status == 2);
  CHECK_THAT(option.err, Contains("--tire"));
  const auto command = run_program("rnu iso_28580");
  CHECK(command.status == 2);
  CHECK_THAT(command.err, Contains("run"));
  const auto after_option = run_program("--log debug rnu iso_28580");
  CHECK(after_option.status == 2);
  CHECK_THAT(after_option.err, Contains("unknown command 'rnu'") && Contains("nearest  run"));
  CHECK_THAT(run_program("--log=debug rnu iso_28580").err, Contains("nearest  run"));
  CHECK_THAT(run_program("export c3_315_80r22_5 --vecto t.xml --force").err, Contains("unknown option '--force'"));
  CHECK(run_program("").status == 2);
  CHECK(run_program("run iso_28580").status == 2);
}

TEST_CASE("errors stay within 80 columns, with all that is allowed and paths whole", "[fast]") {
  for (const char* arguments : {"run nope --tire a50", "diagnose --explain nope", "describe nope",
                                "run iso_28580 --tire a50 --set effects.nope.x=1", "export . --mat x"}) {
    const auto run = run_program(arguments);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(longest_line(run.err) <= 80);
  }
  const std::string path = "no_such_folder_of_a_rather_long_name/and another one below it/and at last a tire file.toml";
  CHECK_THAT(run_program("validate '" + path + "'").err, Contains("  where    " + path + "\n"));
}

TEST_CASE("a run that fails exits with 3 and says why", "[fast]") {
  // a heat balance that no step can follow
  const auto run = run_program("run iso_28580 --tire a50 --set tire.bounded.conductance_W_per_K=1e300");
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("run failed"));
}

TEST_CASE("a tire that an effect cools without end is a failed run that names the effect", "[fast]") {
  // a loss of -800 N: the tire drives, and what it gives is taken from its heat
  const std::string effect =
      " --set effects.tire_loss_in_skim.force_N=-20 --set effects.tire_loss_in_skim.load_power=1";
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    const auto run = run_program(std::string("run warm_up --tire a50 --fidelity ") + fidelity + effect, "",
                                 "timeout --foreground 60");
    INFO(fidelity);
    CHECK(run.status == 3);
    CHECK_THAT(run.err, Contains("temperature of the tire's ") && Contains("tire_loss_in_skim (force_N = -20"));
  }
}

TEST_CASE("a tire that heats without end is a failed run of recorded rows, too", "[fast]") {
  // no cooling, and a loss that does not fall with temperature
  const TemporaryFolder folder;
  std::string rows = "time_s,speed_km_h,load_N,ambient_degC,longitudinal_force_N\n";
  for (int i = 0; i <= 2000; i += 2) rows += std::to_string(i) + ",120,5000,25,0\n";
  write_file(folder.file("rows.csv"), rows);
  const auto run = run_program(
      "run follow_roller --tire a50 --set program=rows.csv --set tire.bounded.fall_per_degC=0 --set "
      "tire.bounded.loss_N=5000 --set "
      "tire.thermal.z_W_per_K=0.01 --set tire.thermal.f_W_s_per_m_K=0",
      folder.path());
  INFO(run.out);
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("temperature of the tire's tread"));
}
