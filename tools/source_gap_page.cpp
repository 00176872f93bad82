/// docs/source_gap.md, from what an effect would do to Table 4.3.
#include <fmt/format.h>

#include <cmath>

#include "sim/core/units.h"
#include "tools/skim_question.h"
#include "tools/source_gap.h"

namespace rollrig::tools {
namespace {

/// Whether a size is one to be met with.
const char* judge(const GapMatch& found) {
  if (found.at_end) return "none";
  const double far = std::abs(found.u);
  return far <= 1.0 ? "usual" : far <= 2.0 ? "rare" : "no";
}

std::string show_size(const GapMatch& found) { return found.at_end ? "-" : fmt::format("{:.3g}", found.size); }

std::string make_ranking(const std::vector<GapCandidate>& ranked) {
  std::string text =
      "| effect | nearest with one size | physical | misses by, points | nearest, a40 / a50 / a60 | physical | "
      "misses by, points | log weight |\n|---|---|---|---|---|---|---|---|\n";
  for (const GapCandidate& one : ranked) {
    const auto& tire = one.of_tire;
    text += fmt::format(
        "| `{}` | {} {} | {} | {:.1f} | {} / {} / {} | {} / {} / {} | {:.1f} / {:.1f} / {:.1f} | {:.0f} |\n",
        one.effect->info.id, show_size(one.common), unit_of_key(one.effect->info.parameters.front().key).symbol,
        judge(one.common), one.common.rms_points, show_size(tire[0]), show_size(tire[1]), show_size(tire[2]),
        judge(tire[0]), judge(tire[1]), judge(tire[2]), tire[0].rms_points, tire[1].rms_points, tire[2].rms_points,
        one.log_weight);
  }
  return text;
}

/// Effects whose log weight comes within ten of the best.
std::string list_likely(const std::vector<GapCandidate>& ranked) {
  constexpr double kMuchLess = 10.0;
  std::string text;
  for (const GapCandidate& one : ranked) {
    if (one.log_weight < ranked.front().log_weight - kMuchLess) break;
    text += fmt::format("{}`{}`", text.empty() ? "" : ", ", one.effect->info.id);
  }
  return text;
}

std::string make_table_text(const PowerErrors& table) {
  std::string text = "| tire | city | highway | constant speed |\n|---|---|---|---|\n";
  for (std::size_t t = 0; t < kTires.size(); ++t) {
    text += fmt::format("| {} | {:.1f} % | {:.1f} % | {:.1f} % |\n", kTires[t], 100.0 * table[t][0],
                        100.0 * table[t][1], 100.0 * table[t][2]);
  }
  return text;
}

constexpr const char* kPage = R"(# The source's own gap, and its open question

Written by `source_gap_page`, not by hand; `tests/published/source_gap_test.cpp` holds it to what the program says.

## Table 4.3: rolling power on the dynamometer

Mean error between modeled and measured rolling power of an undriven front tire, printed without sign:

{table}
Which unmodeled effect would make this pattern? Each effect that acts on a dynamometer is added to the drive of §3.4.4
(quarter load, 5400 N, 280 kPa, 23 degC, the tires of assets/tires) at sizes from -3 to 6 units of its prior, its shapes
at the middle of theirs; the error is the mean over samples above 20 km/h of (model - measured)/measured, the measured
power being the model's and what the effect adds to the loss between hub and roller. That Table 4.3 is this mean is
assumed. "Nearest" is the size that comes nearest to the nine errors, or to a tire's three; "physical" says whether the
prior has it: usual within one unit, rare within two, no beyond, none where no size tried comes near. The log weight
counts misses in units of 2 points (Assumed) and the size by its prior, with one size for all tires, or with one a tire
where the effect is the tire's.

### If the measured power is above the model's

Likeliest: {above_likely}.

{above}
### If it is below

Likeliest: {below_likely}.

{below}
## Is the parasitic loss that falls in the warm-up the tire's or the rig's? (§5.2)

The source saw it fall in a transient skim test and had no data to decide. Its own test, simulated on its rig with its
sensors and a log of one sample a second, with one of the two causes at work at the middle and at both ends of its
prior, diagnosed with the whole catalog in the comparison:

{skim}
)";

}  // namespace

std::string make_source_gap_page(const std::string& published_folder) {
  const PowerErrors table = read_table_4_3(published_folder);
  const std::vector<GapCurve> curves = simulate_gap_curves(models::all_effects());
  const std::vector<GapCandidate> above = rank_gap(curves, table, true);
  const std::vector<GapCandidate> below = rank_gap(curves, table, false);
  using fmt::literals::operator""_a;
  return fmt::format(kPage, "table"_a = make_table_text(table), "above_likely"_a = list_likely(above),
                     "above"_a = make_ranking(above), "below_likely"_a = list_likely(below),
                     "below"_a = make_ranking(below), "skim"_a = make_skim_table(ask_all()));
}

}  // namespace rollrig::tools
