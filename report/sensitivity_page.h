#pragma once
/// Page of `rollrig campaign sensitivity`.

#include <string>
#include <vector>

#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// The values that a factor took in the items of a campaign, and the result of each.
struct FactorScatter {
  std::string key;
  std::vector<double> values;   // in the unit of the key; of words, such as names of tires, the place in `words`
  std::vector<double> results;  // as long
  std::vector<std::string> words = {};  // empty where the values are numbers
};

/// From the values as settings take them.
FactorScatter make_factor_scatter(const std::string& key, const std::vector<std::string>& values,
                                  const std::vector<double>& results);

/// The steps in which a factor of elementary effects rises, in the unit of its key: of its four values from the first
/// to the third, and from the second to the fourth. Empty for words, and where items are left out.
std::vector<double> list_factor_steps(const FactorScatter& scatter);

/// The mean result over the first two factors, each in a few ranges: the map of the page, for the document. Null where
/// there are fewer factors.
Json make_factor_means(const std::vector<FactorScatter>& scatters);

/// Of the document of rollrig-sensitivity/1: the index of each factor as bars with its interval, a table, the result
/// over the factors of `scatters`, and a map of its mean over the first two of them. Of each scatter the first 1000
/// points are drawn: all designs fill the space evenly from their beginning.
Page make_sensitivity_page(const Json& sensitivity, const Table& table, const std::string& explanation,
                           const std::vector<FactorScatter>& scatters);

}  // namespace rollrig::report
