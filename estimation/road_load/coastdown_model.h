#pragma once
/// The equation of motion of a coastdown, bin by bin, for fit_road_load().

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "estimation/road_load/coastdown_points.h"
#include "estimation/road_load/road_load_fit.h"

namespace rollrig::estimation {

/// Weather and road of one bin, as factors of the model.
struct BinConditions {
  double rolling = 1.0;   // k
  double density = 1.0;   // q
  double wind_m_s = 0.0;  // h w
  double offset_N = 0.0;  // h m g s, and the wind on a given drag area but for the term below
  double offset_N_s_per_m = 0.0;
};

/// One bin of one run, with what its time depends on.
struct FitBin {
  double high_m_s = 0.0;
  double low_m_s = 0.0;
  double duration_s = 0.0;  // of bins as given; of a trace, found from its two cells
  int upper_cell = -1;      // of a trace
  BinConditions at;
  double upper_samples = 1.0;  // behind the passing time
  double lower_samples = 1.0;
  bool follows = false;  // begins where the bin before it ends
};

struct FitRun {
  std::size_t index = 0;  // in the data
  int heading = 0;
  int wind_column = -1;  // among the coefficients
  std::vector<SpeedCell> cells;
  std::vector<FitBin> bins;
};

/// Runs with their bins between the speeds of the options; runs without any are left out.
std::vector<FitRun> make_fit_runs(const CoastdownData& data, const RoadLoadFitOptions& options,
                                  double effective_mass_kg);

/// Above it, the square of a wind that the headings show is not subtracted. Assumed: nobody coasts down in more
constexpr double kMostFittedWind_m_s = 15.0;

/// Coefficients: A, B, C, then d_0 (where headings are used) and one d_1 a session.
class CoastdownModel {
 public:
  /// `drag_N_s2_per_m2` is what the wind acts on where a drag area is given; without, C.
  CoastdownModel(double mass_kg, bool uses_headings, Eigen::Index coefficients, std::optional<double> drag_N_s2_per_m2)
      : mass_kg_(mass_kg), uses_headings_(uses_headings), count_(coefficients), drag_N_s2_per_m2_(drag_N_s2_per_m2) {}

  Eigen::Index count() const { return count_; }
  double mass_kg() const { return mass_kg_; }
  /// Wind that d_1 of the run's session means, beyond the measured one; 0 where the drag does not tell.
  double wind_m_s(const FitRun& run, const Eigen::VectorXd& coefficients) const;
  double force_N(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients, double speed_m_s) const;
  DecelerationCurve deceleration(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients,
                                 double speed_m_s) const;
  /// The time through a bin, its gradient, and the mean speed.
  struct Passage {
    double duration_s = 0.0;
    Eigen::VectorXd gradient;
    double mean_speed_m_s = 0.0;
    bool possible = true;  // the force is positive throughout
  };
  Passage pass(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients) const;

 private:
  /// Derivatives of the force by the coefficients.
  Eigen::VectorXd factors(const FitRun& run, const FitBin& bin, double speed_m_s, double wind_m_s) const;
  /// What the derivatives times the coefficients leave of the force.
  double rest_N(const FitRun& run, const FitBin& bin, const Eigen::VectorXd& coefficients, double speed_m_s,
                double wind_m_s) const;
  double air_speed_m_s(const FitBin& bin, double speed_m_s) const {
    return speed_m_s + (drag_N_s2_per_m2_.has_value() ? 0.0 : bin.at.wind_m_s);
  }

  double mass_kg_;
  bool uses_headings_;
  Eigen::Index count_;
  std::optional<double> drag_N_s2_per_m2_;
};

}  // namespace rollrig::estimation
