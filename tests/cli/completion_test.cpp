// Completion in a shell, as bash asks for it.
#include <catch2/catch.hpp>
#include <string>

#include "tests/support/run_program.h"

using Catch::Contains;
using rollrig::tests::read_file;
using rollrig::tests::run_other;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

/// What bash offers for the last of `words`, which stand as bash splits a line; with a space after each.
std::string complete(const std::string& words) {
  static const TemporaryFolder folder;
  static const std::string script = run_program("completion bash").out;
  write_file(folder.file("try.sh"), script + "COMP_WORDS=(rollrig " + words +
                                        ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_rollrig\n"
                                        "printf '%s ' \"${COMPREPLY[@]}\"\n");
  const auto tried = run_other("/bin/bash", "try.sh", folder.path());
  CHECK(tried.err.empty());
  return tried.out;
}

}  // namespace

TEST_CASE("bash completes commands and their options", "[fast]") {
  CHECK(complete("diag") == "diagnose ");
  CHECK(complete("fit ro") == "road-load ");
  CHECK(complete("fit road-load --per") == "--per-mass ");
  CHECK(complete("run --fid") == "--fidelity ");
  CHECK(complete("help conv") == "convert ");
  CHECK(complete("help fit t") == "tire ");
  CHECK(complete("--lo") == "--log ");
  CHECK(complete("completion f") == "fish ");
}

TEST_CASE("bash completes values: of options, with = or without, and of lists", "[fast]") {
  CHECK(complete("run iso") == "iso_28580 ");
  CHECK(complete("run --tire a5") == "a50 ");
  CHECK(complete("run iso_28580 --tire = a5") == "a50 ");  // bash takes = for a word
  CHECK(complete("run iso_28580 --tire = ''") == complete("run iso_28580 --tire ''"));
  CHECK(complete("run --rig drum_2") == "drum_2m ");
  CHECK(complete("run drive --vehicle so") == "source_car ");
  CHECK(complete("run drive --set program = ud") == "udds ");
  CHECK(complete("run drive_cycle --set cycle=w") == "wltc_class3b ");
  CHECK(complete("run drive --set prog") == "program=hwfet program=udds program=us06 program=wltc_class3b ");
  CHECK(complete("describe hw") == "hwfet ");
  CHECK(complete("list ve") == "vehicles ");
  CHECK(complete("run --log w") == "warning ");
  CHECK(complete("--log debug run iso") == "iso_28580 ");
  CHECK(complete("diagnose campaign --only bearing_w") == "bearing_warmup ");
  CHECK(complete("diagnose campaign --only windage,bearing_w") == "windage,bearing_warmup ");
  CHECK(complete("diagnose campaign --without = windage,bearing_w") == "windage,bearing_warmup ");
  CHECK_THAT(complete("diagnose --explain ''"), Contains("bearing_warmup ") && Contains("none "));
}

TEST_CASE("where a file may stand, bash completes files", "[fast]") {
  CHECK(complete("validate tr") == "try.sh ");
  CHECK(complete("run --tire ./tr") == "./try.sh ");
  CHECK(complete("diagnose --json tr") == "try.sh ");
}

TEST_CASE("zsh and fish get the same words", "[fast]") {
  for (const char* shell : {"zsh", "fish"}) {
    const auto script = run_program(std::string("completion ") + shell);
    CHECK(script.status == 0);
    CHECK_THAT(script.out, Contains("bearing_warmup") && Contains("iso_28580") && Contains("drum-coastdown") &&
                               Contains("program=udds") && Contains("warning"));
  }
}
