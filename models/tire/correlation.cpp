#include "models/tire/correlation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "models/tire/tire_file.h"

namespace rollrig::models {
namespace {

/// Correlation of the two conductances that follow from [tire_cooling] of a rig. The calibration has one number of the
/// rig, with a fixed ratio of the two.
constexpr double kOneFactor = 0.99;  // Assumed: less than 1, so that data may still change the ratio
constexpr double kRounding = 1e-9;   // Assumed: error of correlations that a program has written

/// A number of a tire that may be uncertain.
struct UncertainNumber {
  std::string table;
  std::string key;
  std::string old_key;
  std::string rig;  // empty: on all rigs that have none of their own
  double sd_SI = 0.0;

  std::string file_key() const { return table + "." + key; }
  bool is_called(const std::string& name) const { return name == file_key() || name == table + "." + old_key; }
  /// As estimation::FreeParameter names it.
  std::string parameter() const { return fmt::format("tire.{}.{}", rig.empty() ? table : "thermal", old_key); }
};

/// The conductances that a rig has of its own.
void add_rig(const std::string& rig, const RigThermal& thermal, std::vector<UncertainNumber>& numbers) {
  const std::string table = "thermal.rig." + rig;
  const auto add = [&](const char* key, const char* old_key, const std::optional<double>& value,
                       const std::optional<double>& sd) {
    if (value.has_value() || sd.has_value()) numbers.push_back({table, key, old_key, rig, sd.value_or(0.0)});
  };
  add("conductance_at_rest_W_per_K", "z_W_per_K", thermal.rest_conductance_W_per_K,
      thermal.rest_conductance_sd_W_per_K);
  add("conductance_per_speed_W_s_per_m_K", "f_W_s_per_m_K", thermal.speed_conductance_W_s_per_m_K,
      thermal.speed_conductance_sd_W_s_per_m_K);
}

std::vector<UncertainNumber> list_numbers(const TireFile& tire) {
  std::vector<UncertainNumber> numbers;
  TireParameters<double>::visit_all(tire.standard_uncertainties,
                                    [&](const std::string& table, const Field& field, double sd_SI) {
                                      numbers.push_back({table, field.key, field.output_key(), "", sd_SI});
                                    });
  for (const auto& [rig, thermal] : tire.rig_thermal) add_rig(rig, thermal, numbers);
  return numbers;
}

/// The number of that name; end() where there is none.
std::vector<UncertainNumber>::const_iterator find_number(const std::vector<UncertainNumber>& numbers,
                                                         const std::string& name) {
  return std::find_if(numbers.begin(), numbers.end(),
                      [&](const UncertainNumber& number) { return number.is_called(name); });
}

InputError mistake(const ConfigValue& at, const std::string& key, const std::string& what, const std::string& allowed,
                   const std::string& nearest = {}) {
  return InputError({what, at.origin.file, at.origin.line, "[correlation] " + key, at.text, allowed, nearest});
}

const ConfigArray& require_array(const ConfigValue& value, const std::string& key, const std::string& allowed) {
  if (value.as_array() == nullptr) throw mistake(value, key, fmt::format("'{}' is not a list", key), allowed);
  return *value.as_array();
}

/// The key that the file's format has for a name; throws where the number has no standard uncertainty.
std::string require_number(const std::vector<UncertainNumber>& numbers, const ConfigValue& value) {
  std::vector<std::string> known;
  std::vector<std::string> uncertain;
  for (const UncertainNumber& number : numbers) {
    known.push_back(number.file_key());
    if (number.sd_SI > 0.0) uncertain.push_back(number.file_key());
  }
  const std::string allowed = uncertain.empty()
                                  ? "numbers with their '_sd'; this tire has none"
                                  : fmt::format("numbers with their '_sd': {}", fmt::join(uncertain, ", "));
  const auto* name = std::get_if<std::string>(&value.data);
  if (name == nullptr) throw mistake(value, "numbers", "the name of a number is not text", allowed);
  const auto found = find_number(numbers, *name);
  if (found == numbers.end()) {
    throw mistake(value, "numbers", fmt::format("the tire has no number '{}'", *name), allowed,
                  nearest_name(*name, known));
  }
  if (found->sd_SI > 0.0) return found->file_key();
  throw mistake(value, "numbers", fmt::format("number '{}' has no standard uncertainty", *name), allowed);
}

std::vector<std::string> read_numbers(const ConfigValue& list, const TireFile& tire) {
  const std::vector<UncertainNumber> known = list_numbers(tire);
  std::vector<std::string> numbers;
  for (const ConfigValue& value : require_array(list, "numbers", "dotted keys of this file, such as \"thermal.x\"")) {
    const std::string key = require_number(known, value);
    if (std::find(numbers.begin(), numbers.end(), key) != numbers.end()) {
      throw mistake(value, "numbers", fmt::format("number '{}' stands twice in the list", key), "each number once");
    }
    numbers.push_back(key);
  }
  return numbers;
}

std::vector<double> read_row(const ConfigValue& value, std::size_t count) {
  const std::string allowed = fmt::format("{0} rows of {0} numbers, as many as 'numbers' has", count);
  const ConfigArray& entries = require_array(value, "matrix", allowed);
  if (entries.size() != count) {
    throw mistake(value, "matrix", fmt::format("a row of the matrix has {} numbers", entries.size()), allowed);
  }
  std::vector<double> row;
  for (const ConfigValue& entry : entries) {
    const auto* number = std::get_if<double>(&entry.data);
    if (number == nullptr) throw mistake(entry, "matrix", "a correlation is not a number", "numbers from -1 to 1");
    if (!(std::abs(*number) <= 1.0)) {
      throw mistake(entry, "matrix", "a correlation is out of range", "numbers from -1 to 1");
    }
    row.push_back(*number);
  }
  return row;
}

/// The diagonal is 1 and both halves are equal; what rounding leaves of that is taken off.
void check_symmetry(const ConfigArray& rows, TireCorrelation& correlation) {
  std::vector<std::vector<double>>& matrix = correlation.matrix;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const std::string& name = correlation.numbers[i];
    if (std::abs(matrix[i][i] - 1.0) > kRounding) {
      throw mistake(rows[i], "matrix", fmt::format("the correlation of '{}' with itself is not 1", name),
                    "1 on the diagonal");
    }
    matrix[i][i] = 1.0;
    for (std::size_t j = 0; j < i; ++j) {
      if (std::abs(matrix[i][j] - matrix[j][i]) > kRounding) {
        throw mistake(rows[i], "matrix",
                      fmt::format("the matrix is not symmetric: '{}' and '{}' have two correlations", name,
                                  correlation.numbers[j]),
                      fmt::format("{} on both sides of the diagonal, or {}", matrix[j][i], matrix[i][j]));
      }
      matrix[j][i] = matrix[i][j];
    }
  }
}

bool is_positive_definite(const std::vector<std::vector<double>>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    matrix.row(i) = Eigen::Map<const Eigen::RowVectorXd>(rows[static_cast<std::size_t>(i)].data(), n);
  }
  return matrix.llt().info() == Eigen::Success;
}

/// Reads and checks the matrix of the numbers, which are there already.
void read_matrix(const ConfigValue& list, TireCorrelation& correlation) {
  const std::size_t count = correlation.numbers.size();
  const std::string allowed = fmt::format("{0} rows of {0} numbers, as many as 'numbers' has", count);
  const ConfigArray& rows = require_array(list, "matrix", allowed);
  if (rows.size() != count) throw mistake(list, "matrix", fmt::format("the matrix has {} rows", rows.size()), allowed);
  for (const ConfigValue& row : rows) correlation.matrix.push_back(read_row(row, count));
  check_symmetry(rows, correlation);
  if (is_positive_definite(correlation.matrix)) return;
  throw mistake(list, "matrix", "the matrix is not positive definite: no numbers can be correlated like that",
                "a positive definite correlation matrix; copy that of a fit without rounding");
}

}  // namespace

TireCorrelation read_correlation(TableReader& file, const TireFile& tire) {
  const ConfigTable* table = file.table("correlation");
  if (table == nullptr) return {};
  TableReader reader(*table, "[correlation]");
  for (const char* key : {"numbers", "matrix"}) {
    if (!reader.has(key)) throw reader.problem(key, fmt::format("missing key '{}'", key), "both numbers and matrix");
    reader.accept(key);
  }
  reader.finish();
  TireCorrelation correlation;
  correlation.numbers = read_numbers(*table->find("numbers"), tire);
  read_matrix(*table->find("matrix"), correlation);
  return correlation;
}

std::string write_correlation(const TireCorrelation& correlation) {
  if (correlation.numbers.empty()) return "";
  std::vector<std::string> rows;
  for (const std::vector<double>& row : correlation.matrix) rows.push_back(fmt::format("  [{}]", fmt::join(row, ", ")));
  return fmt::format("\n[correlation]\nnumbers = [\"{}\"]\nmatrix = [\n{}\n]\n",
                     fmt::join(correlation.numbers, "\", \""), fmt::join(rows, ",\n"));
}

namespace {

bool takes_cooling_of_rig(const TireFile& tire, const std::string& rig) {
  const TireThermalParameters<double>& thermal = tire.values.thermal;
  const bool has_own = thermal.rest_conductance_W_per_K > 0.0 || thermal.speed_conductance_W_s_per_m_K > 0.0;
  return tire.has_thermal && !has_own && tire.rig_thermal.count(rig) == 0;
}

}  // namespace

std::vector<CorrelatedPair> list_correlated_pairs(const TireFile& tire, const std::string& rig) {
  const std::vector<UncertainNumber> numbers = list_numbers(tire);
  std::vector<std::string> parameters;  // empty: does not hold on the rig
  for (const std::string& name : tire.correlation.numbers) {
    const auto number = find_number(numbers, name);
    const bool is_replaced = number != numbers.end() && number->rig.empty() && number->table == "thermal" &&
                             find_number(numbers, fmt::format("thermal.rig.{}.{}", rig, number->key)) != numbers.end();
    const bool holds = number != numbers.end() && !is_replaced && (number->rig.empty() || number->rig == rig);
    parameters.push_back(holds ? number->parameter() : "");
  }
  std::vector<CorrelatedPair> pairs;
  if (takes_cooling_of_rig(tire, rig))
    pairs.push_back({"tire.thermal.z_W_per_K", "tire.thermal.f_W_s_per_m_K", kOneFactor});
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (parameters[i].empty() || parameters[j].empty()) continue;
      pairs.push_back({parameters[i], parameters[j], tire.correlation.matrix[i][j]});
    }
  }
  return pairs;
}

TireCorrelation replace_correlation(const TireFile& tire, TireCorrelation fitted) {
  const std::vector<UncertainNumber> numbers = list_numbers(tire);
  const std::vector<std::string> fitted_numbers = fitted.numbers;
  const auto is_kept = [&](const std::string& name) {
    const auto number = find_number(numbers, name);
    const bool is_fitted = std::count(fitted_numbers.begin(), fitted_numbers.end(), name) > 0;
    return number != numbers.end() && number->sd_SI > 0.0 && !is_fitted;
  };
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < tire.correlation.numbers.size(); ++i) {
    if (is_kept(tire.correlation.numbers[i])) kept.push_back(i);
  }
  for (std::vector<double>& row : fitted.matrix) row.resize(fitted_numbers.size() + kept.size());
  for (const std::size_t i : kept) {
    fitted.numbers.push_back(tire.correlation.numbers[i]);
    std::vector<double>& row = fitted.matrix.emplace_back(fitted_numbers.size());
    for (const std::size_t j : kept) row.push_back(tire.correlation.matrix[i][j]);
  }
  return fitted;
}

}  // namespace rollrig::models
