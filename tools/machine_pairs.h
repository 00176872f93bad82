#pragma once
/// Two machines that differ by one effect, aligned with simulated tires: how well an alignment makes them agree.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "estimation/alignment/alignment.h"

namespace rollrig::tools {

/// What differs between candidate and reference machine.
struct MachineDifference {
  std::string name;   // "bearing_warmup"
  std::string title;  // for a table
  std::string drawn;  // of what size
};
const std::vector<MachineDifference>& list_machine_differences();

/// A further tire: measured once on the candidate, aligned, and on the reference without any scatter.
struct AlignedCase {
  double reference_N_per_kN = 0.0;
  double measured_N_per_kN = 0.0;
  double aligned_N_per_kN = 0.0;
  double half_width_N_per_kN = 0.0;  // of the 95 % interval

  double error_before() const { return measured_N_per_kN - reference_N_per_kN; }
  double error() const { return aligned_N_per_kN - reference_N_per_kN; }
};

/// One pair of machines.
struct MachinePair {
  std::string difference;
  double A2 = 1.0, B2_N_per_kN = 0.0;
  double sigma_m_N_per_kN = 0.0;
  double lack_of_fit_p = 1.0;
  std::vector<AlignedCase> cases;
};

/// How the tires of a pair differ.
enum class TireLoads { kOfItsOwn, kAlike };

/// Five alignment tires and five further ones on two machines, by the quasi-static ISO 28580 test; each alignment tire
/// four times on both, the first time not used. Seeded by `seed` and `index` alone.
/// Validity  Assumed: tires of 6.5 to 11 N/kN, all made from the shipped c1_205_55r16, whose laws of temperature (15 %)
///           and speed (20 %) differ, and with kOfItsOwn their loads, 3 to 6 kN; from one
///           measurement to the next, standard deviations of 0.5 K of the air, 1 kPa of the pressure, 0.3 % of the load
///           and 0.02 N/kN of the reading
MachinePair simulate_pair(const std::string& difference, TireLoads loads, std::uint64_t seed, std::size_t index);

/// `pairs` of each difference. `advance` as of parallel_for().
std::vector<MachinePair> simulate_pairs(const std::vector<std::string>& differences, TireLoads loads, std::size_t pairs,
                                        std::uint64_t seed, const std::function<void(double)>& advance = {});

/// Share of all cases within 0.1 N/kN of the reference.
double find_share_within(const std::vector<MachinePair>& pairs, double limit_N_per_kN = 0.1);
/// A Markdown table: a row for each difference and one of all.
std::string make_pair_table(const std::vector<MachinePair>& pairs);

}  // namespace rollrig::tools
