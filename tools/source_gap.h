#pragma once
/// The source's own gap: Table 4.3, rolling power on the dynamometer against the model, and which effect could make it.
/// And its open question (§5.2): is the parasitic loss that falls in the warm-up the rig's or the tire's?

#include <array>
#include <string>
#include <vector>

#include "models/effect.h"
#include "tools/pages.h"

namespace rollrig::tools {

/// An error of rolling power for each of three tires (a40, a50, a60) and kinds of section (city, highway, constant
/// speed), fractions of the measured power.
using PowerErrors = std::array<std::array<double, 3>, 3>;

/// Table 4.3 as kept in tests/published/table_4_3. Throws InputError.
PowerErrors read_table_4_3(const std::string& folder);

/// What an effect would do to Table 4.3, with one of its signs, at sizes over and beyond its prior.
struct GapCurve {
  const models::Effect* effect = nullptr;
  int sign = 1;                    // of the size, where the prior leaves that open
  std::vector<double> u;           // sizes, in units of the prior
  std::vector<PowerErrors> error;  // (model without it - with it)/with it
};

/// The size at which an effect comes nearest to the table.
struct GapMatch {
  double u = 0.0;           // in units of the prior
  double size = 0.0;        // in the unit of its key
  double rms_points = 0.0;  // of the differences that are left, percentage points
  bool at_end = false;      // of the sizes tried: none comes nearest
};

/// One effect against the table, measured power above or below the model's.
struct GapCandidate {
  const models::Effect* effect = nullptr;
  bool is_of_tire = false;          // it changes the tire's loss, heat or gas: each tire may have its own size
  GapMatch common;                  // one size for all three tires
  std::array<GapMatch, 3> of_tire;  // one for each
  double log_weight = 0.0;          // see rank_gap()
};

/// Simulates every effect that acts on the dynamometer over the source's drive (§3.4.4) at sizes of -3 to 6 prior
/// units, shapes at the middle of their priors.
/// Equation  error = mean over the samples above 20 km/h of (P_model - P_measured)/P_measured, P = loss force x speed
/// Source    Table 4.3's caption; that the mean is over samples, and over sections of a kind, is assumed
std::vector<GapCurve> simulate_gap_curves(const std::vector<const models::Effect*>& effects);

/// All candidates, the likeliest first.
/// Equation  log weight = max over u of sum over tires of (-1/2 sum over kinds ((e - t)/s)^2) - u^2/2; where each tire
///           may have its own size the better of that and of one u a tire, each with its -u^2/2
/// Symbols   e, t error with the effect and in the table; s = 0.02 (Assumed: four times by how much the model of the
///           drive misses the energies of Tables 4.4 and 4.5)
/// `measured_above`: the table's unprinted sign. True where the measured power is above the model's
std::vector<GapCandidate> rank_gap(const std::vector<GapCurve>& curves, const PowerErrors& table, bool measured_above);

/// What the diagnosis says of the source's own test (transient skim, §3.2.7) in which one of the two causes of the open
/// question is at work.
struct SkimAnswer {
  std::string tire;
  std::string truth;  // effect at work
  double size = 0.0;  // of it, in the unit of its key
  std::string size_unit;
  std::string named;            // cause, or the verdict where none is named
  double bearing_warmup = 0.0;  // probabilities
  double tire_loss_in_skim = 0.0;
  std::string next_test;
};

/// Simulates the test on the source's drum with its sensors (one log a second, seed 1), and diagnoses it by comparison
/// of the whole catalog.
SkimAnswer ask(const std::string& tire, const std::string& effect, const std::string& parameter, double size);

/// Every tire at the middle of both priors, and a50 at both ends of each.
std::vector<SkimAnswer> ask_all();

/// The answers as rows of a table.
Rows list_answers(const std::vector<SkimAnswer>& answers);

}  // namespace rollrig::tools
