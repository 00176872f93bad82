#pragma once
/// The drive-cycle part of docs/published.md: Tables 4.2, 4.4, 4.5, 5.1, Figure 3.13, temperatures.

#include <string>

namespace rollrig::tools {

/// Tables of energy. `folder`: tests/published, with the numbers of the source.
std::string make_energy_tables(const std::string& folder);

/// What §4.3.1, §4.4.1 and §4.4.3 say in words of temperature and RRc, one by one: holds or not, by how much.
std::string make_statement_table();

}  // namespace rollrig::tools
