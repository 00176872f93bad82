#pragma once
/// Mistakes planted in the runs of measurement sets, and how often they are found.

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::tests {

/// A mistake in one run, and the words that must be in the warning.
struct PlantedMistake {
  std::string name;
  std::string words;
  std::function<void(measurements::MeasuredRun&, std::mt19937_64&)> plant;
};

/// Units, signs, levers and exchanged columns of a set's kind.
std::vector<PlantedMistake> list_wrong_columns(const measurements::MeasurementSet& set);
/// Pairs of columns whose numbers are within the ranges of each other in all runs, exchanged; else the reader refuses
/// the file.
std::vector<PlantedMistake> list_exchanged_columns(const measurements::MeasurementSet& set);
/// Times in minutes. Milliseconds of runs of more than 260 s are refused by the reader, which names them.
PlantedMistake make_minutes();
/// A column of which one number fills a whole run.
PlantedMistake make_still_column(const std::string& column, double number);
/// A stretch of 30 to 300 s in which every column follows a straight line.
PlantedMistake make_interpolated(const measurements::MeasurementSet& set, const std::vector<std::string>& columns);

/// How often it was found in so many sets.
struct PlantedScore {
  int planted = 0;
  int found = 0;
  int named = 0;                    // rightly
  int untold = 0;                   // not named, but among those of which it is said that they cannot be told apart
  int innocent = 0;                 // runs beside the mistaken one
  int accused = 0;                  // of these
  std::vector<std::string> misses;  // what was said instead
};

/// Plants a mistake in a random run of each set and checks the set.
PlantedScore score(const PlantedMistake& mistake, const std::vector<measurements::MeasurementSet>& sets,
                   std::uint64_t seed);

/// Plants two different ones of these in two random runs of each set. Found and named count each of the two.
PlantedScore score_two(const std::vector<PlantedMistake>& mistakes,
                       const std::vector<measurements::MeasurementSet>& sets, std::uint64_t seed);

/// Plants a mistake in all runs of each set: one planting a set.
PlantedScore score_in_all(const PlantedMistake& mistake, const std::vector<measurements::MeasurementSet>& sets,
                          std::uint64_t seed);

/// `count` runs of a set, drawn at random.
measurements::MeasurementSet draw_runs(const measurements::MeasurementSet& set, std::size_t count,
                                       std::mt19937_64& random);

/// Number of plantings of each mistake: that of the environment variable ROLLRIG_PLANTINGS, else `usual`.
int count_plantings(int usual);

}  // namespace rollrig::tests
