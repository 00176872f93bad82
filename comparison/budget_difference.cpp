#include "comparison/budget_difference.h"

#include <cmath>
#include <limits>

#include "estimation/uncertainty/budget.h"

namespace rollrig::comparison {
namespace {

const Json* find_line(const Json& budget, const Json& like) {
  for (const Json& line : budget.at("contributions")) {
    if (line.at("name") == like.at("name") && line.at("key") == like.at("key")) return &line;
  }
  return nullptr;
}

/// c u with its sign.
double find_signed(const Json& line) {
  const double size = line.at("contribution").get<double>();
  const Json& sensitivity = line.at("sensitivity");
  return sensitivity.is_number() && sensitivity.get<double>() < 0.0 ? -size : size;
}

double find_freedom(const Json& line) {
  const Json& found = line.at("degrees_of_freedom");
  return found.is_number() ? found.get<double>() : std::numeric_limits<double>::infinity();
}

/// Sums of the variances of a difference.
struct VarianceSum {
  double variance = 0.0;
  double fourth = 0.0;  // of u_i^4/nu_i

  void add(double contribution, double freedom) {
    const double square = contribution * contribution;
    variance += square;
    fourth += square * square / freedom;
  }
};

}  // namespace

Relation SharedInputs::find(const Json& contribution) const {
  if (is_same_run) return Relation::kCommon;
  const std::string name = contribution.at("name");
  const bool is_drawn = contribution.at("type") == "A" || name.rfind("noise", 0) == 0;
  if (is_drawn) return Relation::kIndependent;
  const bool is_of_tire = contribution.at("key") == "tire";
  return (is_of_tire ? has_one_tire : has_one_machine) ? Relation::kCommon : Relation::kIndependent;
}

DifferenceUncertainty calc_difference_uncertainty(const Json& reference, const Json& other,
                                                  const SharedInputs& shared) {
  VarianceSum sum;
  for (const Json& line : reference.at("contributions")) {
    const Json* beside = find_line(other, line);
    if (beside != nullptr && shared.find(line) == Relation::kCommon) {
      sum.add(find_signed(*beside) - find_signed(line), find_freedom(line));
      continue;
    }
    sum.add(find_signed(line), find_freedom(line));
    if (beside != nullptr) sum.add(find_signed(*beside), find_freedom(*beside));
  }
  for (const Json& line : other.at("contributions")) {
    if (find_line(reference, line) == nullptr) sum.add(find_signed(line), find_freedom(line));
  }
  const double freedom =
      sum.fourth > 0.0 ? sum.variance * sum.variance / sum.fourth : std::numeric_limits<double>::infinity();
  return {std::sqrt(sum.variance), estimation::calc_coverage_factor(std::max(1.0, freedom))};
}

InputNames name_inputs(const Json& reference, const Json& other, const SharedInputs& shared) {
  InputNames names;
  for (const Json& line : reference.at("contributions")) {
    if (!(line.at("contribution").get<double>() > 0.0)) continue;
    const bool is_common = find_line(other, line) != nullptr && shared.find(line) == Relation::kCommon;
    (is_common ? names.common : names.independent).push_back(line.at("name"));
  }
  for (const Json& line : other.at("contributions")) {
    if (find_line(reference, line) == nullptr && line.at("contribution").get<double>() > 0.0) {
      names.independent.push_back(line.at("name"));
    }
  }
  return names;
}

}  // namespace rollrig::comparison
