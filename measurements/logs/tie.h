#pragma once
/// What ties two clocks together: a channel of the tire log that follows something of the torque log.

#include <vector>

#include <Eigen/Dense>

#include "models/sensor.h"

namespace rollrig::measurements {

/// From the tire log's clock to the torque log's.
struct Clock {
  double reference_s = 0.0;  // on the tire log's clock: there the two differ by shift_s
  double shift_s = 0.0;
  double rate = 0.0;  // s/s by which the torque log's clock runs faster

  double to_torque(double tire_s) const { return tire_s + shift_s + rate * (tire_s - reference_s); }
};

/// Functions of time on the torque log's clock, linear between nodes.
struct Basis {
  std::vector<double> node_s;
  std::vector<std::vector<double>> functions;
};

/// A channel of the tire log as a sum of functions of the torque log's time, which the clock moves, and of functions of
/// its own time, which it does not: y(t) = sum_i a_i f_i(torque time of t) + sum_j b_j g_j(t) + noise.
struct Tie {
  Quantity channel;
  bool is_common = false;      // else a response of the tire
  std::vector<double> time_s;  // on the tire log's clock
  std::vector<double> values;
  Basis basis;                  // f
  std::vector<double> decay_s;  // g: a constant, and exp(-t/decay) for each
  models::SensorParameters noise;
};

/// A tie at one setting of the clock, whitened, over the rows that both logs cover.
struct TieFit {
  std::size_t count = 0;  // rows
  std::size_t rank = 0;   // of f and g
  double chi2 = 0.0;
  double chi2_alone = 0.0;      // with g only
  std::vector<double> time_s;   // of the rows
  Eigen::VectorXd rest;         // y less f and g, not whitened
  Eigen::VectorXd rest_white;   // likewise, whitened
  Eigen::MatrixXd slope_white;  // of f by shift and by rate, less what f and g can take up
};

/// Fits a tie. With `with_slopes` also the derivatives, by differences over `step_s`.
TieFit fit_tie(const Tie& tie, const Clock& clock, bool with_slopes, double step_s = 0.0);

/// Means over groups of rows, so that at most `most` are left.
Tie thin_tie(const Tie& tie, std::size_t most);

/// Noise that a fit's rest shows: white and first-order drift, by maximum likelihood.
models::SensorParameters estimate_noise(const TieFit& fit, const models::SensorParameters& start);

}  // namespace rollrig::measurements
