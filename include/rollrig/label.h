#pragma once
/// The EU label's class of a tire by its rolling resistance, and the limits of type approval. Sources: docs/label.md.

#include <optional>
#include <string>
#include <vector>

#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// What the class is to be found for. Errors name a member as the option of the command line: rrc_N_per_kN as "--rrc".
struct LabelInput {
  std::optional<double> rrc_N_per_kN;     // of ISO 28580; absent: by the simulated test of the tire
  std::optional<double> rrc_sd_N_per_kN;  // its standard uncertainty; absent: the preferred limit of sigma_m
  std::string tire_class;                 // "C1", "C2" or "C3"; empty: that of the tire, or of a load index from 122
  std::string load_index;                 // "91" or "91V"; checked against the class
  std::string speed_symbol;               // "V"; likewise
  bool is_severe_snow = false;            // for severe snow conditions; limits are then 1 N/kN higher
  std::string tire;                       // name of an asset, or a path
};

/// One class of the label.
struct LabelClassShare {
  std::string name;                      // "A" to "E"
  std::optional<double> upper_N_per_kN;  // highest declared RRc; none of E
  double probability = 0.0;              // that the RRc is in this class
};

/// One limit of type approval.
struct ApprovalLimit {
  int stage = 0;
  double upper_N_per_kN = 0.0;
  bool is_met = false;       // by the declared RRc
  double probability = 0.0;  // that it is met
};

/// Class and limits; as a report without page and files.
struct TireLabel : Report {
  std::string tire_class;
  std::string label_class;
  double rrc_N_per_kN = 0.0;
  double declared_rrc_N_per_kN = 0.0;  // rounded to 0.1 N/kN
  double rrc_sd_N_per_kN = 0.0;
  std::vector<LabelClassShare> classes;
  std::vector<ApprovalLimit> limits;
  std::vector<std::string> warnings;
};

/// Finds the class. With a tire and no RRc, the test of ISO 28580 is simulated.
/// Example  make_label({8.4, {}, "C1", {}, {}, false, {}}).label_class is "C"
/// Errors   InputError: neither RRc nor tire; an RRc that no tire has, as by a mistaken unit; no class, an unknown one,
///          or one that contradicts load index or speed symbol; an unknown tire, load index or symbol
TireLabel make_label(const LabelInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
