#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "report/heat_course.h"
#include "report/run_page.h"
#include "rigs/vehicle_channels.h"
#include "scenarios/common/vehicle_conditions.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using models::Node;

/// The wheel that is drawn: the only one, or the first of the vehicle that rolls.
struct SectionWheel {
  std::string position;
  std::size_t axle = 0;
};

std::optional<SectionWheel> find_section_wheel(const scenarios::RunSpec& spec,
                                               const sim::Recording<double>& recording) {
  if (!spec.vehicle.has_value()) return SectionWheel{};
  if (recording.find(models::quantities::kLoad) != nullptr) {
    return SectionWheel{"", scenarios::VehicleConditions::find_axle(spec)};
  }
  for (std::size_t axle = 0; axle < spec.vehicle->axles.size(); ++axle) {
    const std::string position = rigs::name_wheels(*spec.vehicle, spec.vehicle->axles[axle]).front();
    const Quantity load = rigs::wheel_channel(models::quantities::kLoad, position);
    if (recording.find(load) != nullptr) return SectionWheel{position, axle};
  }
  return std::nullopt;
}

const char* word_of(Node node) {
  switch (node) {
    case Node::kLiner:
      return "liner";
    case Node::kGas:
      return "gas";
    case Node::kTread:
      return "tread";
    case Node::kRim:
      return "rim";
    default:
      return "further";
  }
}

Json round_all(const std::vector<double>& values, double per_unit, double offset = 0.0) {
  Json json = Json::array();
  for (const double value : values) json.push_back(std::round(per_unit * (value + offset)) / per_unit);
  return json;
}

constexpr double kTenths = 10.0;       // of a watt: less than a tire's flows are known to
constexpr double kHundredths = 100.0;  // of a kelvin

void add_heat(const HeatCourse& course, Block& block) {
  block["t"] = round_all(course.time_s, 1000.0);
  double low_K = course.nodes.front().temperature_K.front();
  double high_K = low_K;
  for (const HeatNode& node : course.nodes) {
    block["nodes"].push_back({{"node", word_of(node.node)},
                              {"name", node.name},
                              {"degC", round_all(node.temperature_K, kHundredths, -kZeroCelsius_K)}});
    const auto [least, most] = std::minmax_element(node.temperature_K.begin(), node.temperature_K.end());
    low_K = std::min(low_K, *least);
    high_K = std::max(high_K, *most);
  }
  block["range_degC"] = {std::floor(low_K - kZeroCelsius_K), std::ceil(high_K - kZeroCelsius_K)};
  block["generated_W"] = round_all(course.generated_W, kTenths);
  block["to_air_W"] = round_all(course.to_air_W, kTenths);
  block["to_surface_W"] = round_all(course.to_surface_W, kTenths);
  std::vector<double> stored_W;  // by the heat balance: the change of recorded temperatures has the sensors' noise
  for (std::size_t i = 0; i < course.generated_W.size(); ++i) {
    stored_W.push_back(course.generated_W[i] - course.to_air_W[i] - course.to_surface_W[i]);
  }
  block["stored_W"] = round_all(stored_W, kTenths);
  block["links"] = Json::array();
  for (const HeatLink& link : course.links) {
    block["links"].push_back(
        {{"from", word_of(link.from)}, {"to", word_of(link.to)}, {"W", round_all(link.mean_W, kTenths)}});
  }
}

std::string describe_nodes(const HeatCourse& course) {
  std::vector<std::string> names;
  for (const HeatNode& node : course.nodes) names.push_back(node.name);
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

}  // namespace

std::optional<Block> make_cross_section(const scenarios::RunSpec& spec, const sim::Recording<double>& recording) {
  constexpr std::size_t kMostStretches = 720;  // four hours in stretches of 20 s
  const std::optional<SectionWheel> wheel = find_section_wheel(spec, recording);
  if (!wheel.has_value()) return std::nullopt;
  const std::optional<HeatCourse> course =
      find_heat_course(spec, recording, wheel->position, wheel->axle, kMostStretches);
  if (!course.has_value()) return std::nullopt;
  const models::TireFile& tire =
      spec.vehicle.has_value() ? rigs::tire_of(spec.vehicle->axles[wheel->axle], spec.tire) : spec.tire;
  const bool is_belt = spec.rig.kind->traits.surface == models::Surface::kBelt;
  const bool is_road = spec.vehicle.has_value() && spec.rig.drum.diameter_m <= 0.0;
  const char* surface = is_belt ? "belt" : is_road ? "road" : spec.vehicle.has_value() ? "roller" : "drum";
  const std::string of_wheel = wheel->position.empty() ? "" : fmt::format(", wheel {}", plain_name(wheel->position));
  const models::TireGeometry<double>& geometry = tire.values.geometry;
  Block block = {
      {"type", "cross_section"},
      {"label",
       fmt::format("Section through the tire above the {} at the slider's time, with its heat flows", surface)},
      {"title", fmt::format("Heat in the tire{}", of_wheel)},
      {"surface", surface},
      {"width_m", rounded(geometry.section_width_m)},
      {"radius_m", rounded(geometry.outer_diameter_m / 2.0)},
      {"rim_radius_m", rounded(geometry.rim_diameter_m / 2.0)},
      {"nodes", Json::array()},
      {"caption",
       fmt::format("Section of {}, to scale in width and height. The tire's model has a temperature each for {}; parts "
                   "without one of their own have the color of their neighbor, and what the model does not have is "
                   "gray. Flows are those of the model at the recorded states, means over a stretch of the recording; "
                   "the width of an arrow is its power. Loss = to air + to {} + stored.",
                   tire.designation, describe_nodes(*course), surface)}};
  add_heat(*course, block);
  return block;
}

}  // namespace rollrig::report
