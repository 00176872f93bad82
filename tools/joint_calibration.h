#pragma once
/// The joint calibration of the source's three tires: what is free, and every published number that it is held to.

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "models/tire/own_number.h"
#include "tools/published_numbers.h"
#include "tools/virtual_run.h"

namespace rollrig::tools::joint {

inline constexpr const char* kCapacity = "heat_capacity_J_per_K";

/// A number of the tire's own model, or its heat capacity.
template <class Values>
auto find_number(Values& tire, const std::string& key) {
  return key == kCapacity ? &tire.thermal.heat_capacity_J_per_K : models::find_own_number(tire.own, key);
}

/// The rigs whose heat transfer is calibrated: at_rest_W_per_m2_K of [tire_cooling], its rise with speed in proportion.
inline const std::array<std::string, 2> kRigs{"drum_2m", "dyno_1m2"};

/// Rigs of the assets that cool tires like these (Assumed), themselves among them.
inline const std::map<std::string, std::vector<std::string>> kRigsAlike{
    {"drum_2m", {"drum_2m", "drum_1m7", "flat_belt"}},
    {"dyno_1m2", {"dyno_1m2", "dyno_48in", "dyno_48in_2wd", "road"}}};

/// A free number of a tire: a key of [bounded], or heat_capacity_J_per_K.
struct FreeNumber {
  std::size_t tire;  // of kTires
  const char* key;
  bool is_positive;  // its logarithm is fitted
};

/// At most six of a tire. What is held is at the value of the files: the load exponent of a40, because less cooling on
/// the drum has the same effect; the conductance between tread and carcass of a50; both rises with
/// speed of a60, which come out at their limit of 0.
const std::vector<FreeNumber>& list_free_numbers();

/// Free numbers of the tires, then the logarithms of the rigs' heat transfer.
using Unknowns = std::vector<double>;

/// Tires and rigs as files have them.
struct CalibratedFiles {
  std::array<models::TireFile, 3> tires;
  std::array<rigs::RigFile, 2> rigs;
};

/// One residual: (virtual - published) / sd, or how far the virtual number is outside a range.
struct Observation {
  std::string table;  // or section of the thesis; "order", "cold", "prior"
  std::string name;
  double published = 0.0;
  double fitted = 0.0;
  double sd = 1.0;
  double residual = 0.0;
};

/// What one tire does in the virtual tests, by name.
using TireResults = std::map<std::string, double>;

class JointCalibration {
 public:
  JointCalibration(CalibratedFiles files, const std::string& published_folder);

  Unknowns read_unknowns() const;
  /// The files with these numbers in them.
  CalibratedFiles put(const Unknowns& at) const;
  /// All residuals, in an order that never changes.
  std::vector<Observation> observe(const Unknowns& at) const;
  /// Residuals of these tables, and of no others, are 0 from now on.
  void leave_out(const std::set<std::string>& tables) { left_out_ = tables; }

 private:
  /// Simulates a tire only where its numbers or those of the rigs are new.
  const TireResults& find_results(std::size_t tire, const Unknowns& at, const CalibratedFiles& files) const;

  CalibratedFiles files_;
  std::array<PublishedTire, 3> published_;
  std::set<std::string> left_out_;
  mutable std::array<std::map<std::vector<double>, TireResults>, 3> simulated_;
};

/// "a40 ln loss_N" and so on.
std::string name_of_unknown(std::size_t i);
/// Root mean square of virtual less published over the observations of some tables.
double find_rms(const std::vector<Observation>& observations, const std::vector<std::string>& tables);

/// The tires and rigs of the assets. Throws InputError.
CalibratedFiles read_files();

/// The ISO test of a tire: what it reports, and the share of the true loss that is left after the skim test.
struct IsoTest {
  double rrc_N_per_kN = 0.0;
  double reported_share = 0.0;
};
IsoTest run_iso_test(const scenarios::RunSpec& spec);

}  // namespace rollrig::tools::joint
