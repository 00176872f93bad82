#pragma once
/// The interface of the shared library that links Ceres. It is loaded at the first fit, and not before, since to load
/// what Ceres links takes time (docs/architecture.md).

#include "estimation/least_squares/least_squares.h"

namespace rollrig::estimation {

/// What the library does. All is virtual, so that a program needs no symbol of the library to call it.
class LeastSquaresLibrary {
 public:
  virtual ~LeastSquaresLibrary() = default;
  virtual LeastSquaresResult minimize(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                                      std::vector<double>& unknowns) const = 0;
};

/// The only function that the library exports.
using LeastSquaresEntry = const LeastSquaresLibrary* (*)();
constexpr const char* kLeastSquaresEntry = "rollrig_least_squares_library";

}  // namespace rollrig::estimation
