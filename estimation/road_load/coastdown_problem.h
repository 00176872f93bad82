#pragma once
/// Coastdowns as a linear model about present coefficients, with the kinds of scatter that bins and runs share.

#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_model.h"
#include "estimation/road_load/variance_components.h"

namespace rollrig::estimation {

/// Kinds of scatter: of passing times, along a run, from run to run (constant; in proportion to speed), from
/// session to session (SessionShape).
enum CoastdownScatter : Eigen::Index { kPassing, kGust, kRunForce, kRunSpeed, kSession, kComponents };
constexpr double kRunSpeedScale_m_s = 20.0;  // makes the two components of runs alike in size

/// How the force by which a session differs goes with speed: the same force at all speeds (as with a colder tire), or
/// the same share of the force (as if a clock were wrong).
enum class SessionShape { kConstant, kProportional };

/// The problem in one place: runs, model, and the sessions behind the wind columns.
struct CoastdownProblem {
  std::vector<FitRun> runs;
  CoastdownModel model;
  std::vector<std::string> wind_sessions;
  std::vector<std::vector<std::size_t>> groups;  // runs that share scatter: those of a session, if there are several
  bool has_several_sessions = false;
  bool has_repeats = false;  // several sessions, one of which has two runs or more
  SessionShape session_shape = SessionShape::kConstant;
};

CoastdownProblem make_problem(const CoastdownData& data, const RoadLoadFitOptions& options, double mass_kg);

/// Drag per square of speed at the reference density, from a given drag area.
std::optional<double> given_drag(const RoadLoadFitOptions& options);

/// Time through every bin, by the present coefficients where a trace is condensed.
std::vector<double> find_durations_s(const CoastdownModel& model, const FitRun& run,
                                     const Eigen::VectorXd& coefficients);

/// Mean forces of a run as observations of a linear model about the present coefficients.
LinearBlock linearize(const CoastdownProblem& problem, const FitRun& run, const Eigen::VectorXd& coefficients,
                      const Eigen::VectorXd& components);
/// The same of all runs, a block a group.
std::vector<LinearBlock> linearize_all(const CoastdownProblem& problem, const Eigen::VectorXd& coefficients,
                                       const Eigen::VectorXd& components);

/// Whether the force is positive at every speed of the data.
bool all_possible(const CoastdownProblem& problem, const Eigen::VectorXd& coefficients);

/// A, B, C by ordinary least squares on plain differences; a constant where that gives a force below zero.
/// Throws RunFailure when the speed does not fall.
Eigen::VectorXd start_coefficients(const CoastdownProblem& problem);

}  // namespace rollrig::estimation
