#pragma once
/// Pairs of machines that test the same tire: two measurement sets each, with at most one effect on one of them.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/generator/measurement_set.h"
#include "validation/generator/validation_set.h"

namespace rollrig::generator {

/// Effects by which one machine may differ from another: bearings, load cell, thermometer of the air, diameter of the
/// drum, surface, speed.
constexpr std::array<const char*, 6> kPairEffects{"bearing_warmup", "load_record",       "ambient_record",
                                                  "drum_diameter",  "surface_roughness", "speed_record"};
/// Effects that the tire may have on both machines alike.
constexpr std::array<const char*, 4> kPairTireEffects{"load_exponent", "pressure_exponent", "rubber_memory",
                                                      "tread_liner_lag"};

struct PairsOrder {
  std::uint64_t seed = 1;
  int differing = 200;  // pairs with an effect on one machine, by kPairEffects in turn; sizes small, middle, large
  int none = 40;        // pairs without; every other one has an effect of the tire on both machines
  int runs = 3;         // of each machine
  std::string out;
};

/// A pair: the orders of both sets. The first effects of both are the tire's (SetOrder::common_effects).
struct PairPlan {
  std::string name;
  std::array<SetOrder, 2> sets;
  std::string effect;       // by which they differ; empty: none
  std::size_t on = 0;       // machine that has it
  std::string tire_effect;  // on both; empty: none
};

/// Drums with the same tire and the same kinds of runs; rig, sensors, air, true numbers of the rig, lengths of phases
/// and noise are each machine's own.
std::vector<PairPlan> draw_pairs(const PairsOrder& order);

/// How clearly an ideal observer sees that the machines differ, who knows the effect and all equations, but neither
/// the numbers of the tire, which are common, nor those of the machines, nor the offsets of the sensors.
/// Equation  d'^2 = s^T C^-1 s,  C = N + U U^T over both sets
/// Symbols   s what the effect changes on its machine, 0 on the other; N noise; U columns of the unknowns, those of the
///           tire's numbers over both sets
/// Checked   tests/validation/generator/machine_pairs_test.cpp
double find_pair_detectability(const PairPlan& pair);

/// Writes <out>/sets/<number>/a and b, and <out>/truth.json with its SHA-256 beside it.
void write_pairs(const PairsOrder& order, const MakeItems& make_items,
                 const std::function<void(const std::string&)>& hashed);

}  // namespace rollrig::generator
