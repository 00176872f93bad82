#include "estimation/alignment/alignment_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "estimation/uncertainty/common_inputs.h"

namespace rollrig::estimation {
namespace {

constexpr double kRrcUnit = 1e-3;  // N/kN

double to_SI(double rrc_N_per_kN) { return kRrcUnit * rrc_N_per_kN; }
double from_SI(double rrc) { return rrc / kRrcUnit; }

/// An error of one value, of mean 0, whose standard deviation is from the estimate of some scatter.
UncertainInput make_error(const std::string& name, double sd_N_per_kN, const std::vector<UncertainInput>& scatter,
                          const std::string& source) {
  UncertainInput input{name, "rrc_N_per_kN", 0.0, to_SI(sd_N_per_kN)};
  input.source = source;
  share_scatter(scatter, input);
  return input;
}

UncertainInput make_measured_input(const AlignmentLine& line, int measurements,
                                   const std::vector<UncertainInput>& scatter) {
  return make_error("sigma_m of the measured value", line.sigma_m / std::sqrt(static_cast<double>(measurements)),
                    scatter, "sigma_m of the candidate machine, from the repeats");
}

UncertainInput make_between_input(const AlignmentLine& line, const std::vector<UncertainInput>& scatter) {
  return make_error("tire-to-tire scatter about the line", line.between_sd, scatter,
                    "scatter about the line beyond that of the repeats");
}

void add_inputs(std::vector<UncertainInput> more, std::vector<UncertainInput>& inputs) {
  std::move(more.begin(), more.end(), std::back_inserter(inputs));
}

const std::vector<std::string> kAlignmentLeftOut{
    "A1 and B1: their laboratory has to state them",
    "the reference machine's own deviation, where it is not in A1 and B1",
    "drift of the candidate machine since the alignment: the control tires show it"};

}  // namespace

MeasurementModel make_alignment_model(const AlignmentResult& result) {
  const LineFit& fit = result.fit;
  const std::size_t p = fit.points.size();
  const double x_sd = result.line.candidate_sd, y_sd = result.line.rest_sd;
  MeasurementModel model;
  model.measurands = {{"A2", "A2"},
                      {"B2", "B2_N_per_kN"},
                      {"aligned, least RRc", "aligned_least_N_per_kN"},
                      {"aligned, middle", "aligned_middle_N_per_kN"},
                      {"aligned, greatest RRc", "aligned_greatest_N_per_kN"}};
  const std::vector<UncertainInput> of_x =
      make_scatter_inputs(p, result.sigma_m.degrees_of_freedom, "candidate machine: means of the tires",
                          "sigma_m of the candidate machine, from the repeats");
  const std::vector<UncertainInput> of_y = make_scatter_inputs(
      p, result.line.rest_freedom, "reference values, scatter about the line",
      "scatter about the line or, where that is smaller, of the repeats, less that of the candidate machine");
  add_inputs(of_x, model.inputs);
  add_inputs(of_y, model.inputs);
  model.inputs.push_back(make_measured_input(result.line, 1, of_x));
  model.inputs.push_back(make_between_input(result.line, of_y));
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
    const LineFit again = fit_line(x, y, {});
    std::vector<double> results{again.slope, to_SI(again.offset)};
    const double measured_error = from_SI(take_scale(inputs, 0, p) * inputs[2 * p + 2]);
    const double between = from_SI(take_scale(inputs, p + 1, p) * inputs[2 * p + 3]);
    for (const double value : measured) {
      results.push_back(to_SI(line.A1 * (again.value(value + measured_error) + between) + line.B1));
    }
    return results;
  };
  return model;
}

MeasurementModel make_aligned_value_model(const AlignmentLine& line, double rrc_N_per_kN, int measurements) {
  MeasurementModel model;
  model.measurands = {{"aligned RRc", "aligned_N_per_kN"}};
  const std::vector<UncertainInput> of_x =
      make_scatter_inputs(2, line.sigma_m_freedom, "A2 and B2, by sigma_m of the candidate machine",
                          "sigma_m of the candidate machine, from the repeats");
  const std::vector<UncertainInput> of_y =
      make_scatter_inputs(2, line.rest_freedom, "A2 and B2, by the reference values",
                          "scatter of the alignment tires about the line, less that of the candidate machine");
  add_inputs(of_x, model.inputs);
  add_inputs(of_y, model.inputs);
  model.inputs.push_back(make_measured_input(line, measurements, of_x));
  model.inputs.push_back(make_between_input(line, of_y));
  model.left_out = kAlignmentLeftOut;
  model.evaluate = [line, rrc_N_per_kN](const std::vector<double>& inputs) {
    const std::vector<double> of_candidate = take_scatter(inputs, 0, 2), of_rest = take_scatter(inputs, 3, 2);
    const auto combine = [&](std::size_t i) {
      return line.A2 * line.candidate_sd * of_candidate[i] + line.rest_sd * of_rest[i];
    };
    const double level = line.A2 * line.mean_x + line.B2 + combine(0) / std::sqrt(line.tires);
    const double slope = line.A2 + combine(1) / std::sqrt(line.Sxx);
    const double measured_error = from_SI(take_scale(inputs, 0, 2) * inputs[6]);
    const double between = from_SI(take_scale(inputs, 3, 2) * inputs[7]);
    const double reference = level + slope * (rrc_N_per_kN + measured_error - line.mean_x) + between;
    return std::vector<double>{to_SI(line.A1 * reference + line.B1)};
  };
  return model;
}

}  // namespace rollrig::estimation
