#include "estimation/alignment/alignment_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "estimation/uncertainty/usual_inputs.h"
#include "include/rollrig/error.h"

namespace rollrig::estimation {
namespace {

constexpr double kRrcUnit = 1e-3;  // N/kN

double to_SI(double rrc_N_per_kN) { return kRrcUnit * rrc_N_per_kN; }
double from_SI(double rrc) { return rrc / kRrcUnit; }

/// A line whose points have no order is a failed trial.
LineFit fit_line_again(const std::vector<double>& x, const std::vector<double>& y) {
  try {
    return fit_line(x, y, {});
  } catch (const std::invalid_argument& error) {
    throw RunFailure(error.what());
  }
}

/// An error of one value, of mean 0.
UncertainInput make_error(const std::string& name, double sd_N_per_kN, double degrees_freedom,
                          const std::string& source) {
  UncertainInput input{
      name, "rrc_N_per_kN", 0.0, to_SI(sd_N_per_kN), Distribution::kStudentT, Evaluation::kTypeA, degrees_freedom};
  if (!std::isfinite(degrees_freedom)) input.distribution = Distribution::kNormal;
  input.source = source;
  return input;
}

void add_inputs(std::vector<UncertainInput> more, std::vector<UncertainInput>& inputs) {
  std::move(more.begin(), more.end(), std::back_inserter(inputs));
}

/// The errors of a further tire: of its measured value, and of what tires differ by beside the line.
void add_tire_inputs(const AlignmentLine& line, int measurements, std::vector<UncertainInput>& inputs) {
  inputs.push_back(make_error("measured value of the further tire",
                              line.sigma_m / std::sqrt(static_cast<double>(measurements)), line.sigma_m_freedom,
                              "sigma_m of the candidate machine, from the repeats"));
  inputs.push_back(make_error("what tires differ by beside the line", line.between_sd, line.between_freedom,
                              "scatter about the line beyond that of the repeats"));
}

const std::vector<std::string> kAlignmentLeftOut{
    "A1 and B1: their laboratory has to state them",
    "the reference machine's own deviation, where it is not in A1 and B1",
    "drift of the candidate machine since the alignment: the control tires show it"};

}  // namespace

MeasurementModel make_alignment_model(const AlignmentResult& result) {
  const LineFit& fit = result.fit;
  const std::size_t p = fit.points.size();
  const double x_sd = fit.candidate_sd;
  const double y_sd = std::sqrt(std::max(0.0, fit.sd * fit.sd - std::pow(fit.slope * x_sd, 2)));
  MeasurementModel model;
  model.measurands = {{"A2", "A2"},
                      {"B2", "B2_N_per_kN"},
                      {"aligned value, tire of least RRC", "aligned_least_N_per_kN"},
                      {"aligned value, middle of the range", "aligned_middle_N_per_kN"},
                      {"aligned value, tire of greatest RRC", "aligned_greatest_N_per_kN"}};
  add_inputs(make_scatter_inputs(p, result.sigma_m.degrees_of_freedom, "measured means of the alignment tires",
                                 "sigma_m of the candidate machine, from the repeats"),
             model.inputs);
  add_inputs(make_scatter_inputs(p, fit.freedom, "values of the reference, and tires about the line",
                                 "the larger of the scatter about the line and that of the repeats"),
             model.inputs);
  add_tire_inputs(result.line, 1, model.inputs);
  model.left_out = kAlignmentLeftOut;
  const auto [least, greatest] = std::minmax_element(fit.points.begin(), fit.points.end(),
                                                     [](const LinePoint& a, const LinePoint& b) { return a.x < b.x; });
  const std::array<double, 3> measured{least->x, 0.5 * (least->x + greatest->x), greatest->x};
  model.evaluate = [fit, line = result.line, p, x_sd, y_sd, measured](const std::vector<double>& inputs) {
    const std::vector<double> x_errors = take_scatter(inputs, 0, p);
    const std::vector<double> y_errors = take_scatter(inputs, p + 1, p);
    std::vector<double> x, y;
    for (std::size_t i = 0; i < p; ++i) {
      x.push_back(fit.points[i].x + x_sd * x_errors[i]);
      y.push_back(fit.value(fit.points[i].x) + y_sd * y_errors[i]);
    }
    const LineFit again = fit_line_again(x, y);
    std::vector<double> results{again.slope, to_SI(again.offset)};
    for (const double value : measured) {
      const double aligned = again.value(value + from_SI(inputs[2 * p + 2]));
      results.push_back(to_SI(line.A1 * (aligned + from_SI(inputs[2 * p + 3])) + line.B1));
    }
    return results;
  };
  return model;
}

MeasurementModel make_aligned_value_model(const AlignmentLine& line, double rrc_N_per_kN, int measurements) {
  MeasurementModel model;
  model.measurands = {{"aligned coefficient", "aligned_N_per_kN"}};
  model.inputs =
      make_scatter_inputs(2, line.line_freedom, "A2 and B2", "scatter of the alignment tires about the line");
  add_tire_inputs(line, measurements, model.inputs);
  model.left_out = kAlignmentLeftOut;
  model.evaluate = [line, rrc_N_per_kN](const std::vector<double>& inputs) {
    const std::vector<double> errors = take_scatter(inputs, 0, 2);
    const double level = line.A2 * line.mean_x + line.B2 + line.line_sd / std::sqrt(line.tires) * errors[0];
    const double slope = line.A2 + line.line_sd / std::sqrt(line.Sxx) * errors[1];
    const double reference = level + slope * (rrc_N_per_kN + from_SI(inputs[3]) - line.mean_x) + from_SI(inputs[4]);
    return std::vector<double>{to_SI(line.A1 * reference + line.B1)};
  };
  return model;
}

}  // namespace rollrig::estimation
