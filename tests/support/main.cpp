// Catch2's main takes 20 s to compile: one for all test programs.
#define CATCH_CONFIG_RUNNER
#include <malloc.h>

#include <catch2/catch.hpp>

int main(int argc, char** argv) {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // as rollrig does (cli/program.cpp)
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  return Catch::Session().run(argc, argv);
}
