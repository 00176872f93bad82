#pragma once
/// Sizes and indices of the standard library as Eigen has them, with a sign.

#include <Eigen/Core>

#include <cstddef>

namespace rollrig::diagnosis {

inline Eigen::Index to_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace rollrig::diagnosis
