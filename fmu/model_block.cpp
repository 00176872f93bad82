#include "fmu/model_block.h"

#include <cstring>

namespace rollrig::fmu {
namespace {

/// In the data of the library. Volatile, since it is not as it was compiled.
volatile char block[kModelBlockSize] = ROLLRIG_MODEL_BLOCK_MARK;

BlockContent read_block() {
  std::string text;
  for (std::size_t i = sizeof(ROLLRIG_MODEL_BLOCK_MARK) - 1; i < kModelBlockSize && block[i] != '\0'; ++i) {
    text += block[i];
  }
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return {"", read_wheel_model("")};
  return {text.substr(0, end), read_wheel_model(std::string_view(text).substr(end + 1))};
}

}  // namespace

const BlockContent& read_own_block() {
  static const BlockContent content = read_block();
  return content;
}

}  // namespace rollrig::fmu
