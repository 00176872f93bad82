#include "report/heat_course.h"

#include <algorithm>
#include <cmath>

#include "models/corner.h"
#include "models/quantities.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/vehicle_channels.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

namespace quantities = models::quantities;
using models::Node;
using HeatColumn = const std::vector<double>*;

models::Context<double> make_heat_context(const scenarios::RunSpec& spec, std::size_t axle) {
  if (spec.vehicle.has_value()) return scenarios::make_wheel_context(spec, spec.vehicle->axles[axle]);
  return rigs::make_context(spec.tire, spec.rig, spec.baseline);
}

/// What a corner has to know of a row, as recorded.
struct CornerColumns {
  HeatColumn speed, load, contact_load, ambient, surface, force, resistance, pressure;
  std::vector<HeatColumn> states;  // in the order of the corner's

  CornerColumns(const models::Corner<double>& corner, const sim::Recording<double>& recording,
                const std::string& position) {
    const auto find = [&](const Quantity& quantity) { return recording.find(rigs::wheel_channel(quantity, position)); };
    speed = recording.find(quantities::kSpeed);
    load = find(quantities::kLoad);
    contact_load = find(quantities::kContactLoad);
    ambient = recording.find(quantities::kAmbient);
    surface = recording.find(quantities::kSurfaceTemperature);
    force = find(quantities::kLongitudinalForce);
    resistance = find(quantities::kRollingResistance);
    pressure = find(quantities::kCavityPressure);
    for (const models::CornerState& state : corner.states()) states.push_back(find(state.quantity));
    states[corner.state_of(Node::kLiner)] = find(quantities::kLinerTemperature);
    states[corner.state_of(Node::kGas)] = find(quantities::kGasTemperature);
  }

  bool is_whole() const {
    const auto is_missing = [](HeatColumn column) { return column == nullptr; };
    return speed != nullptr && load != nullptr && contact_load != nullptr && ambient != nullptr &&
           resistance != nullptr && pressure != nullptr && std::none_of(states.begin(), states.end(), is_missing);
  }
};

/// The corner at a row of the recording.
class RowEvaluation {
 public:
  RowEvaluation(const models::Corner<double>& corner, const CornerColumns& columns)
      : corner_(corner), columns_(columns), state_(corner.state_count()), rates_(corner.state_count()) {}

  const models::Instant<double>& at(std::size_t row) {
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = (*columns_.states[i])[row];
    fill_inputs(row);
    corner_.apply_inputs(state_.data(), now_);
    now_.motion.speed_m_s = now_.acting.speed_m_s;
    now_.motion.load_N = (*columns_.contact_load)[row];
    corner_.calc_losses(state_.data(), now_);
    const models::RollingWheel<double> wheel = models::find_rolling_wheel(now_);
    now_.motion.longitudinal_force_N = columns_.force != nullptr ? (*columns_.force)[row] : wheel.loss_at_wheel_N;
    models::put_slip(wheel, models::calc_slip(now_), now_.motion);
    if (now_.rolling_resistance_N > 0.0) {  // the heat of what was recorded
      now_.heating_force_N *= (*columns_.resistance)[row] / now_.rolling_resistance_N;
    }
    corner_.calc_rates(state_.data(), now_, rates_.data());
    return now_;
  }

  double stored_J() const { return corner_.calc_stored_heat_J(state_.data()); }

 private:
  void fill_inputs(std::size_t row) {
    models::InputPort<double>& inputs = now_.recorded;
    inputs.speed_m_s = (*columns_.speed)[row];
    inputs.load_N = (*columns_.load)[row];
    inputs.ambient_K = (*columns_.ambient)[row];
    inputs.surface_recorded = columns_.surface != nullptr;
    inputs.surface_K = inputs.surface_recorded ? (*columns_.surface)[row] : inputs.ambient_K;
    inputs.longitudinal_force_N = columns_.force != nullptr ? (*columns_.force)[row] : 0.0;
    inputs.air_density_ratio = 1.0;
    // The pressure is the recorded one. An effect on it is already in the recorded resistance.
    now_.inflation = {(*columns_.pressure)[row], state_[corner_.state_of(Node::kGas)], kStandardAtmosphere_Pa};
  }

  const models::Corner<double>& corner_;
  const CornerColumns& columns_;
  std::vector<double> state_, rates_;
  models::Instant<double> now_;
};

std::vector<HeatNode> list_heat_nodes(const models::Corner<double>& corner) {
  std::vector<HeatNode> nodes;
  for (std::size_t i = 0; i < models::kNodeCount; ++i) {
    if (!corner.nodes()[i]) continue;
    const Node node = static_cast<Node>(i);
    HeatNode one{node, node == Node::kGas ? "gas" : node == Node::kRim ? "rim" : "tread"};
    for (const auto& [of_model, name] : corner.context().tire.model().info.nodes) {
      if (of_model == node) one.name = name;
    }
    nodes.push_back(std::move(one));
  }
  return nodes;
}

/// The flows at one instant, in one order: generated, to air, to surface, then links.
std::vector<double> list_flows(const models::Instant<double>& now, const std::vector<HeatLink>& links) {
  std::vector<double> flows_W{now.heat.heat_in_W, now.heat.to_air_W, now.heat.to_road_W};
  for (const HeatLink& link : links) {
    const std::size_t a = models::index_of(link.from);
    const std::size_t b = models::index_of(link.to);
    flows_W.push_back(now.thermal.link_W_per_K[std::min(a, b)][std::max(a, b)] *
                      (now.thermal.temperature_K[a] - now.thermal.temperature_K[b]));
  }
  return flows_W;
}

std::vector<HeatLink> list_links(const std::vector<HeatNode>& nodes) {
  std::vector<HeatLink> links;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = a + 1; b < nodes.size(); ++b) links.push_back({nodes[a].node, nodes[b].node});
  }
  return links;
}

bool is_idle(const HeatLink& link) {
  return std::all_of(link.mean_W.begin(), link.mean_W.end(), [](double flow_W) { return flow_W == 0.0; });
}

/// Adds up flows over the rows of a stretch, and puts its means into the course.
class StretchSums {
 public:
  explicit StretchSums(HeatCourse& course) : course_(course), sums_J_(kTotals + course.links.size(), 0.0) {}

  void begin(std::vector<double> flows_W) { before_W_ = std::move(flows_W); }

  void add(double length_s, std::vector<double> flows_W) {
    for (std::size_t i = 0; i < flows_W.size(); ++i) sums_J_[i] += 0.5 * length_s * (before_W_[i] + flows_W[i]);
    before_W_ = std::move(flows_W);
  }

  void end(double length_s) {
    std::vector<double>* totals_W[kTotals] = {&course_.generated_W, &course_.to_air_W, &course_.to_surface_W};
    for (std::size_t i = 0; i < sums_J_.size(); ++i) {
      std::vector<double>& means_W = i < kTotals ? *totals_W[i] : course_.links[i - kTotals].mean_W;
      means_W.push_back(length_s > 0.0 ? sums_J_[i] / length_s : 0.0);
      sums_J_[i] = 0.0;
    }
  }

 private:
  static constexpr std::size_t kTotals = 3;  // in the order of list_flows()

  HeatCourse& course_;
  std::vector<double> sums_J_;
  std::vector<double> before_W_;
};

}  // namespace

std::optional<HeatCourse> find_heat_course(const scenarios::RunSpec& spec, const sim::Recording<double>& recording,
                                           const std::string& position, std::size_t axle, std::size_t most) {
  const models::Corner<double> corner(make_heat_context(spec, axle), spec.effects);
  const CornerColumns columns(corner, recording, position);
  const std::vector<double>& time_s = recording.time_s;
  if (!columns.is_whole() || time_s.size() < 2) return std::nullopt;
  RowEvaluation evaluation(corner, columns);
  HeatCourse course;
  course.nodes = list_heat_nodes(corner);
  course.links = list_links(course.nodes);
  const auto end_stretch = [&](std::size_t row) {
    course.time_s.push_back(time_s[row]);
    course.stored_J.push_back(evaluation.stored_J());
    for (HeatNode& node : course.nodes) {
      node.temperature_K.push_back((*columns.states[corner.state_of(node.node)])[row]);
    }
  };
  StretchSums sums(course);
  sums.begin(list_flows(evaluation.at(0), course.links));
  end_stretch(0);
  const std::size_t last = time_s.size() - 1;
  const std::size_t step = (last - 1) / most + 1;
  for (std::size_t row = 1; row <= last; ++row) {
    sums.add(time_s[row] - time_s[row - 1], list_flows(evaluation.at(row), course.links));
    if (row % step != 0 && row != last) continue;
    sums.end(time_s[row] - course.time_s.back());
    end_stretch(row);
  }
  course.links.erase(std::remove_if(course.links.begin(), course.links.end(), is_idle), course.links.end());
  return course;
}

}  // namespace rollrig::report
