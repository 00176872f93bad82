// Catch2's main takes 20 s to compile: one for all test programs.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
