#pragma once
/// Tire a50 on the source's law with the coefficients of its own example.

#include <vector>

namespace rollrig::tools {

/// Conductances of a50 that were fitted with the coefficients of Figure 3.13.
struct CoolingFit {
  double rest_conductance_W_per_K = 0.0;
  double speed_conductance_W_s_per_m_K = 0.0;
  double rms = 0.0;                 // over the eight sections of Tables 4.4 and 4.5, a fraction
  std::vector<double> differences;  // of them, virtual, in the order driven
};

/// a50 with A and B of Figure 3.13 (55.1434 N, 0.0177 at 80 km/h; 64.7752 N, 0.0191 at 120 km/h; 80 km/h is
/// 22.22 m/s) at a heat capacity, and z and f on the dynamometer fitted to Tables 4.4 and 4.5.
/// `published` as of PublishedTire::sections(). Throws RunFailure when the fit does not converge.
CoolingFit fit_cooling_to_figure_3_13(const std::vector<double>& published, double heat_capacity_J_per_K);

}  // namespace rollrig::tools
