/// Entry points for libFuzzer. The environment variable ROLLRIG_FUZZ_TARGET names the reader.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/fuzz/mutator.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

const rollrig::fuzz::Target& chosen_target() {
  static const rollrig::fuzz::Target& target = []() -> const rollrig::fuzz::Target& {
    const char* name = std::getenv("ROLLRIG_FUZZ_TARGET");
    return rollrig::fuzz::find_target(name == nullptr ? "" : name);
  }();
  return target;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const rollrig::tests::TemporaryFolder folder;
  rollrig::fuzz::execute(chosen_target(), {reinterpret_cast<const char*>(data), size}, folder.path());
  return 0;
}

/// libFuzzer's own changes, which coverage guides byte by byte, and those of mutate(), in turn.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  rollrig::fuzz::Engine engine(seed);
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::string changed = rollrig::fuzz::mutate(input, input, most, engine);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
