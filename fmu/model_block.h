#pragma once
/// The block of the FMU's shared object that `rollrig export fmu` fills with the model of a wheel, so that the FMU
/// needs no file when it runs.

#include <cstddef>
#include <string>

#include "fmu/wheel_model.h"

namespace rollrig::fmu {

constexpr std::size_t kModelBlockSize = 65536;
/// With this a block begins.
#define ROLLRIG_MODEL_BLOCK_MARK "rollrig model block of a wheel:"

/// What is in the block of this shared object: a token by which an importer and an FMU know each other, and the model.
struct BlockContent {
  std::string token;
  WheelModel model;
};

/// Throws RunFailure where the block is empty.
const BlockContent& read_own_block();

}  // namespace rollrig::fmu
