#pragma once
/// By how much the rolling-resistance coefficient that one machine measured exceeds that of the other.

#include "diagnosis/comparison/prepared_set.h"
#include "include/rollrig/machine_pair.h"

namespace rollrig::diagnosis {

/// The coefficient on the first machine less that on the second, read as a laboratory reads it: of the last minute at
/// each load and constant speed, loss under load less loss in skim, over the load. The simulation only makes up for what
/// was not the same in the two tests: speeds, loads, pressures, air, drum.
/// Equation  F_k - F_sim,k = o_s + d_m L_k + e_k, d = d_A - d_B, by least squares
/// Symbols   F_k force at the surface, mean of block k, F_sim,k simulated (`simulated`, of all blocks of the set); o_s
///           offset of the session s: free where the session has a skim test, else within the offset of the sensor;
///           L_k load [N], 0 in skim; d_m of machine m; e_k noise and drift of the sensor
/// Interval  95 %; of noise and drift, or of the scatter of the runs about the line where that is larger. The scatter
///           is the sum over runs of the squared score, with n/(n - 2) and Student's t of n - 2 degrees of freedom for
///           n runs
/// Validity  two machines. NaN where one of them has no constant speed under load
/// Source    the variance from sums over clusters: Liang and Zeger, Biometrika 73 (1986) 13; not read
/// Checked   tests/diagnosis/machine_rrc_difference_test.cpp
rollrig::RrcEstimate read_rrc_difference(const PreparedSet& set, const Eigen::VectorXd& simulated);

/// The coefficient on the second machine over that on the first, each over its own simulated one, so that the ratio is 1
/// where the machines agree, whatever the speeds, loads and pressures of their tests.
/// Equation  (d_B/d_sim,B)/(d_A/d_sim,A), with d_m of F and d_sim,m of F_sim by the line of read_rrc_difference()
/// Validity  NaN where one of the machines has no constant speed under load, or a coefficient is not positive
/// Checked   tests/diagnosis/machine_rrc_difference_test.cpp
double read_rrc_ratio(const PreparedSet& set, const Eigen::VectorXd& simulated);

}  // namespace rollrig::diagnosis
