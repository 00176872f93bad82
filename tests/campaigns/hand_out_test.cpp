// Items that are handed out: all of them, in shares that become small towards the end.
#include "campaigns/mpi/hand_out.h"

#include <catch2/catch.hpp>

namespace {

using rollrig::campaigns::calc_chunk;

}  // namespace

TEST_CASE("shares of items are even at first and single at the end", "[fast]") {
  for (const std::size_t workers : {1U, 3U, 40U}) {
    std::size_t left = 5000;
    std::size_t before = 64;
    while (left > 0) {
      const std::size_t chunk = calc_chunk(left, workers);
      CHECK(chunk <= before);
      CHECK(chunk <= left);
      CHECK((chunk == 1 || chunk * workers <= left / 4 + workers));  // what is left keeps all processes at work
      left -= chunk;
      before = chunk;
    }
    CHECK(before == 1);
  }
}
