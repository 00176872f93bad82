// Catch2's main takes 20 s to compile: one for all test programs.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "sim/core/freed_memory.h"

int main(int argc, char** argv) {
  rollrig::keep_freed_memory();
  return Catch::Session().run(argc, argv);
}
