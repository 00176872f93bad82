#pragma once
/// Heat in a tire over a run: temperatures of its thermal nodes, and what flows between them, to air and to the
/// surface.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/tire/thermal_network.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// A node of the tire's model, as results name it.
struct HeatNode {
  models::Node node = models::Node::kLiner;
  std::string name;
  std::vector<double> temperature_K = {};  // at the ends of the stretches
};

/// Heat from one node to another, mean over each stretch.
struct HeatLink {
  models::Node from = models::Node::kLiner;
  models::Node to = models::Node::kGas;
  std::vector<double> mean_W = {};
};

/// The run cut into stretches of whole rows: temperatures at their ends, flows as means over them.
struct HeatCourse {
  std::vector<double> time_s;  // ends of the stretches: one more than stretches
  std::vector<HeatNode> nodes;
  std::vector<HeatLink> links;
  std::vector<double> generated_W, to_air_W, to_surface_W;  // means over the stretches, of all nodes
  std::vector<double> stored_J;                             // in all nodes at the ends, from 0 K
};

/// Of one wheel ("" where there is one), the first of the vehicle's axle `axle`; in at most `most` stretches. The
/// tire's model, with the effects of the run, is evaluated at the states and inputs of each row. None where the
/// recording lacks one of them.
///
/// Equation  (3.12): sum of stored heat = generated - to air - to surface; heat arises as recorded rolling resistance
///           times rolling speed times the share of it that heats the tire
/// Accuracy  temperatures of liner and gas are recorded as means over a sample: of the heat of a stretch, a few tenths
///           of a percent, and more where the load jumps within it. Errors of sensors enter as they were recorded
/// Checked   tests/report/heat_course_test.cpp
std::optional<HeatCourse> find_heat_course(const scenarios::RunSpec& spec, const sim::Recording<double>& recording,
                                           const std::string& position, std::size_t axle, std::size_t most);

}  // namespace rollrig::report
