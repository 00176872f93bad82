#pragma once
/// What a tire model is: a law of the loss and a thermal network of the tire.
///
/// A tire model is one file, models/tire/<id>.cpp: a struct with a static `info()` and a static function template for
/// each member of TireModelHooks, handed to make_tire_model(). See docs/add_a_tire_model.md.

#include <optional>
#include <string>
#include <vector>

#include "models/ports.h"

namespace rollrig::models {

/// Own parameters that contradict each other.
struct TireModelMistake {
  const char* key;      // of the parameter that the message names
  const char* what;     // is wrong
  std::string allowed;  // values of that parameter
};

/// Everything about a tire model that is not an equation in code.
struct TireModelInfo {
  std::string id;  // `model` in a tire file
  std::string summary;
  std::string equation;
  std::string source;
  std::vector<std::pair<Node, const char*>> nodes;  // beside the gas, kLiner among them; with names for results
  std::vector<std::string> tables;  // of the tire file that it needs: rolling_resistance, thermal, constant
  std::vector<TireModelParameter> parameters{};  // its own, table [<id>] of the tire file
  bool loss_follows_heat = true;                 // whether the loss depends on the tire's temperature
  bool loss_follows_curvature = true;            // whether K of drum_curvature.h applies
  bool has_speed_lines = true;                   // whether [rolling_resistance] has A0 to B1, and a load map
  /// What is wrong with own parameters of which each is within its range; may be null.
  std::optional<TireModelMistake> (*find_mistake)(const OwnParameters<double>&) = nullptr;

  /// Whether numbers of a table of the tire file enter: its own, one of `tables`, or "load_map.0" and so on.
  bool uses(const std::string& table) const;
  /// Whether the loss goes by A0 to B1 of [rolling_resistance].
  bool follows_speed_lines() const { return has_speed_lines && uses("rolling_resistance"); }
};

/// A model's functions for one scalar.
template <class S>
struct TireModelHooks {
  /// Rolling resistance on the reference drum, at the instant's speed, load, pressure and temperature (loss port).
  S (*calc_loss_N)(const Instant<S>&) = nullptr;
  /// Temperature that the law sees before any effect.
  S (*find_loss_temperature_K)(const TireParameters<S>&, const ThermalNetwork<S>&) = nullptr;
  /// Heat capacities and conductances of the model's nodes and of the gas, all of which are zero before.
  void (*fill_network)(const Instant<S>&, ThermalNetwork<S>&) = nullptr;
  /// Puts heat that arises in the tire into the nodes where it arises.
  void (*add_heat)(const TireParameters<S>&, HeatSource, const S& heat_W, ThermalNetwork<S>&) = nullptr;
};

/// A tire model as the registry holds it: what it declares, and its functions for the three scalars.
struct TireModel {
  TireModelInfo info;
  ForEachScalar<TireModelHooks> by_scalar;

  template <class S>
  const TireModelHooks<S>& hooks() const {
    return std::get<TireModelHooks<S>>(by_scalar);
  }
};

/// The model that struct M describes.
template <class M>
const TireModel& make_tire_model() {
  const auto hooks = [](auto scalar) {
    using S = decltype(scalar);
    return TireModelHooks<S>{&M::template calc_loss_N<S>, &M::template find_loss_temperature_K<S>,
                             &M::template fill_network<S>, &M::template add_heat<S>};
  };
  static const TireModel model{M::info(), {hooks(double{}), hooks(Jet{}), hooks(DimensionedScalar{})}};
  return model;
}

/// Ids of all effects or tire models.
template <class Registered>
std::vector<std::string> list_ids(const std::vector<const Registered*>& all) {
  std::vector<std::string> ids;
  for (const Registered* one : all) ids.push_back(one->info.id);
  return ids;
}

/// All models, in the order of models/tire/tire_models.def.
const std::vector<const TireModel*>& all_tire_models();
/// Throws InputError with the nearest known id.
const TireModel& find_tire_model(const std::string& id);

/// For the thermal port of an effect: puts heat into the nodes of the tire in which that of its kind arises.
template <class S>
void add_tire_heat(const Instant<S>& now, HeatSource source, const S& heat_W, ThermalNetwork<S>& network) {
  const TireParameters<S>& tire = now.context->tire;
  tire.model().template hooks<S>().add_heat(tire, source, heat_W, network);
}

}  // namespace rollrig::models
