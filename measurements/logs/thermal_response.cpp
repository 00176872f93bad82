#include "measurements/logs/thermal_response.h"

#include <cmath>

#include "sim/core/interrupt.h"

namespace rollrig::measurements {
namespace {

constexpr double kRubber_s[] = {200.0, 600.0, 2000.0};
constexpr double kGas_s[] = {10.0, 30.0, 90.0};

/// Speed and load on nodes; the load is constant from node to node.
struct Inputs {
  std::vector<double> node_s;
  std::vector<double> speed_m_s;
  std::vector<double> load_N;  // after the node
};

Inputs find_inputs(const Log& log, bool at_rows) {
  Inputs inputs;
  const std::vector<double>& speed = log.columns.at(models::quantities::kSpeed);
  const auto found = log.columns.find(models::quantities::kLoad);
  double load_before = 1.0;
  const auto add = [&inputs](double time_s, double speed_m_s, double load_N) {
    inputs.node_s.push_back(time_s);
    inputs.speed_m_s.push_back(speed_m_s);
    inputs.load_N.push_back(load_N);
  };
  for (std::size_t row = 0; row < log.time_s.size(); ++row) {
    const double load_N = found == log.columns.end() ? 1.0 : found->second[row];
    if (std::isnan(speed[row]) || std::isnan(load_N)) continue;  // on both sides of it a straight line
    if (!inputs.node_s.empty() && !at_rows && load_N != load_before) {
      add(0.5 * (inputs.node_s.back() + log.time_s[row]), 0.5 * (inputs.speed_m_s.back() + speed[row]), load_N);
    }
    add(log.time_s[row], speed[row], load_N);
    load_before = load_N;
  }
  return inputs;
}

/// L_tau of an input that is linear from node to node, from `starts[j]` to `ends[j]`.
std::vector<double> filter(const Inputs& inputs, const std::vector<double>& starts, const std::vector<double>& ends,
                           double tau_s) {
  std::vector<double> filtered(inputs.node_s.size(), 0.0);
  for (std::size_t j = 0; j + 1 < inputs.node_s.size(); ++j) {
    const double x = (inputs.node_s[j + 1] - inputs.node_s[j]) / tau_s;
    const double gone = -std::expm1(-x);
    const double slope = (ends[j] - starts[j]) / x;
    filtered[j + 1] = filtered[j] * (1.0 - gone) + starts[j] * gone + slope * (x - gone);
  }
  return filtered;
}

std::vector<double> combine(const std::vector<double>& slow, double tau_s, const std::vector<double>& fast,
                            double sigma_s) {
  std::vector<double> both(slow.size());
  for (std::size_t j = 0; j < slow.size(); ++j) {
    both[j] = (tau_s * slow[j] - sigma_s * fast[j]) / (tau_s - sigma_s);
  }
  return both;
}

}  // namespace

std::vector<double> response_decays_s(Response response) {
  std::vector<double> decays(std::begin(kRubber_s), std::end(kRubber_s));
  if (response != Response::kRubber) decays.insert(decays.end(), std::begin(kGas_s), std::end(kGas_s));
  return decays;
}

/// What heats and cools, after each node and before the next: F v, F v^2, v, and the first and the last of them times
/// the temperature that F v makes.
struct Drive {
  std::vector<double> starts;
  std::vector<double> ends;
};

std::vector<Drive> make_drives(const Inputs& inputs) {
  constexpr double kTemperature_s = 600.0;
  const std::size_t count = inputs.node_s.size();
  std::vector<Drive> drives(5, Drive{std::vector<double>(count), std::vector<double>(count)});
  for (std::size_t j = 0; j + 1 < count; ++j) {
    const double F = inputs.load_N[j];
    const double before = inputs.speed_m_s[j];
    const double after = inputs.speed_m_s[j + 1];
    const double starts[] = {F * before, F * before * before, before};
    const double ends[] = {F * after, F * after * after, after};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      drives[kind].starts[j] = starts[kind];
      drives[kind].ends[j] = ends[kind];
    }
  }
  const std::vector<double> warmth = filter(inputs, drives[0].starts, drives[0].ends, kTemperature_s);
  for (std::size_t j = 0; j + 1 < count; ++j) {
    for (const auto& [from, to] : {std::pair(0, 3), std::pair(2, 4)}) {
      drives[static_cast<std::size_t>(to)].starts[j] = warmth[j] * drives[static_cast<std::size_t>(from)].starts[j];
      drives[static_cast<std::size_t>(to)].ends[j] = warmth[j + 1] * drives[static_cast<std::size_t>(from)].ends[j];
    }
  }
  return drives;
}

Basis make_response_basis(const Log& torque_log, Response response, bool at_rows) {
  const Inputs inputs = find_inputs(torque_log, at_rows);
  Basis basis;
  basis.node_s = inputs.node_s;
  for (const auto& [starts, ends] : make_drives(inputs)) {
    for (const double tau_s : kRubber_s) {
      throw_if_interrupted();
      const std::vector<double> slow = filter(inputs, starts, ends, tau_s);
      if (response == Response::kRubber) {
        basis.functions.push_back(slow);
        continue;
      }
      for (const double sigma_s : kGas_s) {
        basis.functions.push_back(combine(slow, tau_s, filter(inputs, starts, ends, sigma_s), sigma_s));
      }
    }
  }
  return basis;
}

}  // namespace rollrig::measurements
