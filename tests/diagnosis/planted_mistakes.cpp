#include "tests/diagnosis/planted_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "diagnosis/checks/interpolated.h"
#include "diagnosis/checks/set_checks.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::tests {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

PlantedMistake make_scaled(const std::string& column, double factor, double offset, const std::string& words) {
  return {column + " " + words, words, [column, factor, offset](MeasuredRun& run, std::mt19937_64&) {
            const Unit unit = unit_of_key(column);
            for (double& value : run.columns.at(column)) value = unit.to_si(factor * unit.from_si(value) + offset);
          }};
}

/// Runs that the warnings name: "run a", "runs a, b", "all runs".
std::set<std::string> find_accused(const MeasurementSet& set, const std::string& text) {
  std::set<std::string> accused;
  for (const MeasuredRun& run : set.runs) {
    const std::string id = run.id;
    for (std::size_t at = text.find(id); at != std::string::npos; at = text.find(id, at + 1)) {
      const auto is_edge = [&](std::size_t i) {
        return i >= text.size() || (std::isalnum(static_cast<unsigned char>(text[i])) == 0 && text[i] != '-');
      };
      if ((at == 0 || is_edge(at - 1)) && is_edge(at + id.size())) accused.insert(id);
    }
    if (text.find("all runs") != std::string::npos) accused.insert(id);
  }
  return accused;
}

/// What is said of samples, columns and units.
std::string describe_checks(const MeasurementSet& set) {
  try {
    const diagnosis::SetChecks checks = diagnosis::check_set(set, 1);
    std::string text;
    for (const std::string& warning : checks.warnings) {
      const bool tells = warning.find("looks as if") != std::string::npos ||
                         warning.find("interpolated") != std::string::npos ||
                         warning.find("stand") != std::string::npos || warning.find("further") != std::string::npos;
      if (tells) text += warning + "\n";
    }
    return text;
  } catch (const InputError& error) {
    return error.what();
  }
}

/// Whether there is a sentence that names the run, and for which `has_words` holds.
bool any_sentence(const MeasurementSet& set, const std::string& text, const std::string& id,
                  const std::function<bool(const std::string&)>& has_words) {
  std::vector<std::string> sentences;
  boost::algorithm::split(sentences, text, [](char c) { return c == ';' || c == '\n'; });
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return find_accused(set, sentence).count(id) > 0 && has_words(sentence);
  });
}

/// Whether a sentence that names the run has the words ahead of other likely ones.
bool is_named(const MeasurementSet& set, const std::string& text, const std::string& id, const std::string& words) {
  return any_sentence(set, text, id, [&words](const std::string& sentence) {
    const std::size_t at = sentence.find(words);
    return at != std::string::npos && at <= sentence.find(", or ");
  });
}

/// Whether a sentence that names the run has the words among those that cannot be told apart.
bool is_untold(const MeasurementSet& set, const std::string& text, const std::string& id, const std::string& words) {
  return any_sentence(set, text, id, [&words](const std::string& sentence) {
    return sentence.find(words) != std::string::npos && sentence.find("cannot separate") != std::string::npos;
  });
}

}  // namespace

std::vector<PlantedMistake> list_wrong_columns(const MeasurementSet& set) {
  const std::string force = set.kind->traits.force.header();
  const std::string word = set.kind->word;
  std::vector<PlantedMistake> list{make_scaled("speed_km_h", 1.0 / 3.6, 0.0, "holds m/s"),
                                   make_scaled("speed_km_h", 1.0 / 1.609344, 0.0, "holds mph"),
                                   make_scaled("speed_km_h", 1.0 / 1.852, 0.0, "holds knots"),
                                   make_scaled("ambient_degC", 1.8, 32.0, "holds degF"),
                                   make_scaled(force, -1.0, 0.0, "has the other sign"),
                                   make_scaled(force, 1e-3, 0.0, "holds k")};
  if (word == "road") {
    const double radius_m = 0.5 * set.tire.values.geometry.outer_diameter_m;
    list.push_back(make_scaled(force, radius_m, 0.0, "holds the torque at the wheels"));
    list.push_back(make_scaled("elevation_m", 1.0 / 0.3048, 0.0, "holds feet"));
  } else {
    list.push_back(make_scaled("load_N", 1.0 / 9.80665, 0.0, "holds kgf"));
    list.push_back(make_scaled("load_N", 1.0 / 4.448222, 0.0, "holds lbf"));
    list.push_back(make_scaled("load_N", 1e-3, 0.0, "holds kN"));
    list.push_back(make_scaled("cavity_pressure_kPa", 0.01, 0.0, "holds bar"));
    list.push_back(make_scaled("cavity_pressure_kPa", 1.0 / 6.894757, 0.0, "holds psi"));
    list.push_back(make_scaled("cavity_pressure_kPa", 1.0, 101.325, "is absolute"));
    list.push_back(make_scaled("liner_temperature_degC", 1.8, 32.0, "holds degF"));
  }
  return list;
}

std::vector<PlantedMistake> list_exchanged_columns(const MeasurementSet& set) {
  /// The numbers of one column read as another; empty where one is out of range there.
  const auto read_as = [](const MeasuredRun& run, const rigs::Column& from, const rigs::Column& to) {
    std::vector<double> values;
    for (const double value : run.columns.at(from.quantity)) {
      const double number = from.quantity.file_unit().from_si(value);
      if (std::isnan(number) || !to.range.contains(number)) return std::vector<double>();
      values.push_back(to.quantity.file_unit().to_si(number));
    }
    return values;
  };
  const std::vector<rigs::Column> columns = set.kind->columns.all();
  std::vector<PlantedMistake> list;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = a + 1; b < columns.size(); ++b) {
      const rigs::Column &one = columns[a], &other = columns[b];
      const auto can_be = [&](const MeasuredRun& run) {
        return run.has(one.quantity) && run.has(other.quantity) && !read_as(run, one, other).empty() &&
               !read_as(run, other, one).empty();
      };
      if (!std::all_of(set.runs.begin(), set.runs.end(), can_be)) continue;
      const std::string both = one.quantity.header() + " and " + other.quantity.header();
      list.push_back(
          {both + " exchanged", both + " are exchanged", [one, other, read_as](MeasuredRun& run, std::mt19937_64&) {
             std::vector<double> of_one = read_as(run, other, one);
             run.columns.at(other.quantity) = read_as(run, one, other);
             run.columns.at(one.quantity) = std::move(of_one);
           }});
    }
  }
  return list;
}

PlantedMistake make_minutes() {
  return {"time_s holds min", "time_s holds min", [](MeasuredRun& run, std::mt19937_64&) {
            for (double& time_s : run.time_s) time_s /= 60.0;
          }};
}

PlantedMistake make_still_column(const std::string& column, double number) {
  return {fmt::format("{} stands at {}", column, number), "stands at",
          [column, number](MeasuredRun& run, std::mt19937_64&) {
            for (double& value : run.columns.at(column)) value = unit_of_key(column).to_si(number);
          }};
}

PlantedMistake make_interpolated(const MeasurementSet& set, const std::vector<std::string>& columns) {
  std::map<std::string, double> steps;
  for (const std::string& column : columns) steps[column] = diagnosis::find_step(set, intern_quantity(column));
  return {"interpolated", "interpolated", [columns, steps](MeasuredRun& run, std::mt19937_64& random) {
            // where the force has samples at both ends
            const std::vector<double>& force = run.columns.at(columns.back());
            std::size_t first = 0;
            std::size_t last = 0;
            for (int attempt = 0; attempt < 10000; ++attempt) {
              first = random() % (run.time_s.size() - 40);
              last = std::min(first + 30 + random() % 270, run.time_s.size() - 1);
              std::size_t samples = 0;
              for (std::size_t row = first; row <= last; ++row) samples += std::isnan(force[row]) ? 0 : 1;
              if (!std::isnan(force[first]) && !std::isnan(force[last]) && 2 * samples > last - first) break;
            }
            for (const std::string& column : columns) {
              std::vector<double>& values = run.columns.at(column);
              const double step = steps.at(column);
              for (std::size_t row = first + 1; row < last; ++row) {
                const double share = static_cast<double>(row - first) / static_cast<double>(last - first);
                const double value = values[first] + share * (values[last] - values[first]);
                values[row] = std::round(value / step) * step;
              }
            }
          }};
}

PlantedScore score(const PlantedMistake& mistake, const std::vector<MeasurementSet>& sets, std::uint64_t seed) {
  PlantedScore score;
  std::mt19937_64 random(seed);
  for (const MeasurementSet& clean : sets) {
    MeasurementSet set = clean;
    MeasuredRun& run = set.runs[random() % set.runs.size()];
    mistake.plant(run, random);
    const std::string text = describe_checks(set);
    const std::set<std::string> accused = find_accused(set, text);
    const bool found = accused.count(run.id) > 0;
    const bool named = found && text.find(mistake.words) != std::string::npos &&
                       (text.find(", or ") == std::string::npos || text.find(mistake.words) < text.find(", or "));
    score.planted += 1;
    score.found += found ? 1 : 0;
    score.named += named ? 1 : 0;
    score.untold += !named && is_untold(set, text, run.id, mistake.words) ? 1 : 0;
    score.innocent += static_cast<int>(set.runs.size()) - 1;
    score.accused += static_cast<int>(accused.size()) - (found ? 1 : 0);
    if (!named || accused.size() > 1) score.misses.push_back(run.id + ": " + text);
  }
  return score;
}

PlantedScore score_two(const std::vector<PlantedMistake>& mistakes, const std::vector<MeasurementSet>& sets,
                       std::uint64_t seed) {
  PlantedScore score;
  std::mt19937_64 random(seed);
  for (const MeasurementSet& clean : sets) {
    MeasurementSet set = clean;
    const std::size_t first_run = random() % set.runs.size();
    const std::size_t second_run = (first_run + 1 + random() % (set.runs.size() - 1)) % set.runs.size();
    const std::size_t first = random() % mistakes.size();
    const std::size_t second = (first + 1 + random() % (mistakes.size() - 1)) % mistakes.size();
    const std::pair<std::size_t, std::size_t> planted[] = {{first_run, first}, {second_run, second}};
    for (const auto& [run, mistake] : planted) mistakes[mistake].plant(set.runs[run], random);
    const std::string text = describe_checks(set);
    std::set<std::string> accused = find_accused(set, text);
    bool all_named = true;
    for (const auto& [run, mistake] : planted) {
      const std::string& id = set.runs[run].id;
      score.planted += 1;
      score.found += static_cast<int>(accused.erase(id));
      const bool named = is_named(set, text, id, mistakes[mistake].words);
      score.named += named ? 1 : 0;
      all_named = all_named && named;
    }
    score.innocent += static_cast<int>(set.runs.size()) - 2;
    score.accused += static_cast<int>(accused.size());
    if (!all_named || !accused.empty()) {
      score.misses.push_back(set.runs[first_run].id + " " + mistakes[first].name + ", " + set.runs[second_run].id +
                             " " + mistakes[second].name + ": " + text);
    }
  }
  return score;
}

PlantedScore score_in_all(const PlantedMistake& mistake, const std::vector<MeasurementSet>& sets, std::uint64_t seed) {
  PlantedScore score;
  std::mt19937_64 random(seed);
  for (const MeasurementSet& clean : sets) {
    MeasurementSet set = clean;
    for (MeasuredRun& run : set.runs) mistake.plant(run, random);
    const std::string text = describe_checks(set);
    const bool found = find_accused(set, text).size() == set.runs.size();
    const bool named = found && text.find(mistake.words) != std::string::npos;
    score.planted += 1;
    score.found += found ? 1 : 0;
    score.named += named ? 1 : 0;
    if (!named) score.misses.push_back(text);
  }
  return score;
}

MeasurementSet draw_runs(const MeasurementSet& set, std::size_t count, std::mt19937_64& random) {
  MeasurementSet drawn = set;
  std::shuffle(drawn.runs.begin(), drawn.runs.end(), random);
  drawn.runs.resize(std::min(count, drawn.runs.size()));
  return drawn;
}

int count_plantings(int usual) {
  const char* number = std::getenv("ROLLRIG_PLANTINGS");
  return number != nullptr ? std::atoi(number) : usual;
}

}  // namespace rollrig::tests
