#include "estimation/least_squares/library.h"
#include "sim/core/shared_library.h"

namespace rollrig::estimation {

LeastSquaresResult minimize_squares(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                                    std::vector<double>& unknowns) {
  static void* const entry =
      load_entry(ROLLRIG_LEAST_SQUARES_LIBRARY, kLeastSquaresEntry, "the library of least squares",
                 "only fit tire, fit j2452 and diagnoses need it");
  return reinterpret_cast<LeastSquaresEntry>(entry)()->minimize(problem, options, unknowns);
}

}  // namespace rollrig::estimation
