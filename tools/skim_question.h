#pragma once
/// The source's open question (§5.2): is the parasitic loss that falls in the warm-up the rig's or the tire's?

#include "tools/pages.h"

namespace rollrig::tools {

/// What the diagnosis says of the source's own test (transient skim, §3.2.7) in which one of the two causes is at work.
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
