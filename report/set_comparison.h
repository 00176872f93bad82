#pragma once
/// A measurement set beside simulations of it.

#include <string>
#include <vector>

#include "diagnosis/comparison/prepared_set.h"
#include "diagnosis/diagnosis.h"
#include "models/effect.h"
#include "report/page.h"

namespace rollrig::report {

/// What the sensors would have shown, block by block of every series of the set; empty where it could not be simulated.
struct SimulatedSet {
  std::string name;            // "simulation as calibrated"
  std::vector<double> values;  // SI, by a series' first residual
};

SimulatedSet simulate_set(const diagnosis::PreparedSet& set, const std::string& name,
                          const models::Context<double>& context, const std::vector<models::ActiveEffect>& effects);

/// One run over time: of each channel the measurement with every simulation, and what is left of each.
Block make_comparison(const diagnosis::PreparedSet& set, std::size_t run, const std::vector<SimulatedSet>& simulated);

/// Mean of measured minus simulated of each run, phase and channel, as the map has it: {run, phase, channel, mean,
/// unit}.
Json list_phase_means(const diagnosis::PreparedSet& set, const SimulatedSet& simulated);
/// The same with the files' own numbers, for the document of a diagnosis; empty where the set cannot be simulated.
Json list_phase_means(const measurements::MeasurementSet& set);

/// Measurement less simulation by run, phase and channel. Cells that `where` names are marked, with their z.
Block make_gap_map(const diagnosis::PreparedSet& set, const SimulatedSet& simulated,
                   const std::vector<Location>& where);

}  // namespace rollrig::report
