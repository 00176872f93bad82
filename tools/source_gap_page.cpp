/// docs/source_gap.md, from what an effect would do to Table 4.3.
#include <cmath>

#include "sim/core/units.h"
#include "tools/source_gap.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

/// Whether a size is one to be met with.
const char* judge(const GapMatch& found) {
  if (found.at_end) return "none";
  const double far = std::abs(found.u);
  return far <= 1.0 ? "usual" : far <= 2.0 ? "rare" : "no";
}

std::string show_size(const GapMatch& found) { return found.at_end ? "-" : fmt::format("{:.3g}", found.size); }

Rows list_ranking(const std::vector<GapCandidate>& ranked) {
  Rows rows;
  for (const GapCandidate& one : ranked) {
    const auto& tire = one.of_tire;
    rows.push_back(fmt::format(
        "| `{}` | {} {} | {} | {:.1f} | {} / {} / {} | {} / {} / {} | {:.1f} / {:.1f} / {:.1f} | {:.0f} |",
        one.effect->info.id, show_size(one.common), unit_of_key(one.effect->info.parameters.front().key).symbol,
        judge(one.common), one.common.rms_points, show_size(tire[0]), show_size(tire[1]), show_size(tire[2]),
        judge(tire[0]), judge(tire[1]), judge(tire[2]), tire[0].rms_points, tire[1].rms_points, tire[2].rms_points,
        one.log_weight));
  }
  return rows;
}

/// Effects whose log weight comes within ten of the best.
std::string list_likely(const std::vector<GapCandidate>& ranked) {
  constexpr double kMuchLess = 10.0;
  Rows names;
  for (const GapCandidate& one : ranked) {
    if (one.log_weight < ranked.front().log_weight - kMuchLess) break;
    names.push_back(fmt::format("`{}`", one.effect->info.id));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Rows list_table(const PowerErrors& table) {
  Rows rows;
  for (std::size_t t = 0; t < kTires.size(); ++t) {
    rows.push_back(fmt::format("| {} | {:.1f} % | {:.1f} % | {:.1f} % |", kTires[t], 100.0 * table[t][0],
                               100.0 * table[t][1], 100.0 * table[t][2]));
  }
  return rows;
}

}  // namespace

std::string make_source_gap_page() {
  const PowerErrors table = read_table_4_3(kPublishedFolder);
  const std::vector<GapCurve> curves = simulate_gap_curves(models::all_effects());
  const std::vector<GapCandidate> above = rank_gap(curves, table, true);
  const std::vector<GapCandidate> below = rank_gap(curves, table, false);
  using fmt::literals::operator""_a;
  return fill_page("source_gap", "table"_a = join(list_table(table)), "above_likely"_a = list_likely(above),
                   "above"_a = join(list_ranking(above)), "below_likely"_a = list_likely(below),
                   "below"_a = join(list_ranking(below)), "skim"_a = join(list_answers(ask_all())));
}

}  // namespace rollrig::tools
