#pragma once
/// Tires side by side.

#include <functional>
#include <string>
#include <vector>

#include "comparison/compared.h"
#include "scenarios/run/scenario.h"

namespace rollrig::comparison {

/// A test that is simulated with each of the tires.
struct VirtualTest {
  std::string scenario;
  std::vector<scenarios::RunSpec> runs;  // one for each tire
};

/// Numbers of the tire files, and results of virtual tests. With `threads` as of parallel_for().
/// `advance` gets the share that is done.
/// Equation  u^2(y) = sum_k [f(x + S L e_k) - f(x - S L e_k)]^2 / 4,  u^2(d) = u_A^2 + u_B^2
/// Symbols   x numbers of the tire file with a standard uncertainty, S these uncertainties, L L^T their correlation, e_k
///           unit vector; d difference of the results of two tires
/// Validity  errors of two tire files independent, unless all their numbers are equal: then common. f nearly linear
/// Source    JCGM 100:2008 (GUM) 5.1.2, note 2 of 5.1.3
/// Errors    RunFailure, Interrupted
/// Checked   tests/comparison/compare_test.cpp
Compared compare_tires(const std::vector<models::TireFile>& tires, const std::vector<VirtualTest>& tests,
                       const std::vector<std::string>& names, int threads, const std::function<void(double)>& advance);

}  // namespace rollrig::comparison
