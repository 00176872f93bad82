#pragma once
/// Sizes and places of the standard library as Eigen counts them.

#include <Eigen/Core>

#include <cstddef>

namespace rollrig::diagnosis {

inline Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace rollrig::diagnosis
