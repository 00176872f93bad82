#include "tools/left_out.h"

#include <cmath>

#include "tools/pages.h"

namespace rollrig::tools::joint {
namespace {

/// The observations of a fit, or none where it does not converge. Its numbers are printed.
std::vector<Observation> predict(JointCalibration& tests, const std::set<std::string>& left_out,
                                 const std::function<Unknowns()>& fit) {
  fmt::print("without {}:", fmt::join(left_out, ", "));
  tests.leave_out(left_out);
  std::vector<Observation> predicted;
  try {
    const Unknowns at = fit();
    for (std::size_t i = 0; i < at.size(); ++i) fmt::print(" {} {:.3f}", name_of_unknown(i), at[i]);
    predicted = tests.observe(at);
  } catch (const RunFailure& failure) {
    fmt::print(" {}", failure.what());
  }
  fmt::print("\n");
  tests.leave_out({});
  return predicted;
}

std::string show(const Errors& errors) { return fmt::format("{:.3g} | {:.3g}", errors.rms, errors.largest); }

}  // namespace

const std::vector<LeftOut>& list_left_out() {
  static const std::vector<LeftOut> kAll{
      {"Table 4.2, differences of energy", {"4.2"}, "4.2", "", "Wh"},
      {"Table 4.4, city sections", {"4.4"}, "4.4", "", "points"},
      {"Table 4.5, highway and constant speed", {"4.5"}, "4.5", "", "points"},
      {"Table 5.1, city and highway", {"5.1"}, "5.1", "", "Wh/km"},
      {"Table 4.4, without Table 5.1", {"4.4", "5.1"}, "4.4", "", "points"},
      {"Table 4.5, without Table 5.1", {"4.5", "5.1"}, "4.5", "", "points"},
      {"Table 4.4, without Tables 4.5 and 5.1", {"4.4", "4.5", "5.1"}, "4.4", "", "points"},
      {"Table 4.5, without Tables 4.4 and 5.1", {"4.4", "4.5", "5.1"}, "4.5", "", "points"},
      {"Table 5.1, without Tables 4.4 and 4.5", {"4.4", "4.5", "5.1"}, "5.1", "", "Wh/km"},
      {"RRc of the ISO test", {"RRc"}, "RRc", "", "N/kN"},
      {"§4.1.6, fall over 30 to 35 degC in newtons", {"4.1.6"}, "4.1.6", "drop N", "N"},
      {"§4.1.6, the same in percent", {"4.1.6"}, "4.1.6", "drop %", "points"},
      {"§4.4.3, fall of the temperature over City 3", {"4.4.3"}, "4.4.3", "city 3", "degC"},
      {"§4.4.3, City 2 ends where it starts, ±1 degC", {"4.4.3"}, "4.4.3", "city 2", "degC"},
      {"§4.4.3, RRc of a40 by speed and by temperature", {"4.4.3"}, "4.4.3", "by", "N/kN"},
      {"orders of temperatures and ranges, and of dependences", {"order"}, "order", "", "degC, N/kN"},
      {"§6, start of the warm-up 25 to 40 % above its end", {"6"}, "6", "", "points"},
      {"§4.1.3, RRc spans at most 0.17 N/kN over the load", {"4.1.3"}, "4.1.3", "", "N/kN"},
      {"(4.1), loss of a40 at 250 over that at 280 kPa", {"4.1.4"}, "4.1.4", "", "1"},
      {"§4.1.5, RRc does not fall with speed", {"4.1.5"}, "4.1.5", "", "points"},
      {"limit of this project: cold loss at most 1.45 times that at 25 degC", {"cold"}, "cold", "", "1"}};
  return kAll;
}

Errors find_errors(const std::vector<Observation>& observations, const LeftOut& kind) {
  Errors errors;
  double squares = 0.0;
  std::size_t count = 0;
  for (const Observation& one : observations) {
    if (one.table != kind.table || one.name.find(kind.word) == std::string::npos) continue;
    const double miss = std::abs(one.fitted - one.published);
    squares += miss * miss;
    ++count;
    if (miss <= errors.largest) continue;
    errors.largest = miss;
    errors.worst = one.name;
  }
  errors.rms = std::sqrt(squares / static_cast<double>(count));
  return errors;
}

std::string begin_row(const LeftOut& kind, const Errors& fitted) {
  return fmt::format("| {} | {} | {} | ", kind.title, kind.unit, show(fitted));
}

std::string make_left_out_page(JointCalibration& tests, const std::function<Unknowns()>& fit) {
  const std::vector<Observation> fitted = tests.observe(tests.read_unknowns());
  std::map<std::set<std::string>, std::vector<Observation>> predictions;
  Rows rows;
  for (const LeftOut& kind : list_left_out()) {
    const auto found = predictions.find(kind.left_out);
    if (found == predictions.end()) predictions[kind.left_out] = predict(tests, kind.left_out, fit);
    const std::vector<Observation>& predicted = predictions[kind.left_out];
    const Errors errors = find_errors(predicted, kind);
    rows.push_back(begin_row(kind, find_errors(fitted, kind)) +
                   (predicted.empty() ? "- | - | - |" : fmt::format("{} | {} |", show(errors), errors.worst)));
  }
  using fmt::literals::operator""_a;
  return fill_page("calibration_left_out", "rows"_a = join(rows));
}

}  // namespace rollrig::tools::joint
