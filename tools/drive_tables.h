#pragma once
/// The drive-cycle part of docs/published.md.

#include <map>

#include "tools/pages.h"
#include "tools/tire_drive.h"

namespace rollrig::tools {

/// The source's test driven on each tire, by its name.
using Drives = std::map<std::string, TireDrive>;

struct DriveTables {
  Rows sections;     // Tables 4.4 and 4.5
  Rows figure_3_13;  // a50 with the coefficients of that figure
  Rows figure_3_13_fits;
  Rows table_5_1;
  Rows table_4_2;
  Rows statements;  // of §4.3.1, §4.4.1 and §4.4.3 in words on temperature and RRc: holds or not, by how much
};

DriveTables make_drive_tables();

/// What the source says in words, against `drives`.
Rows list_statements(const Drives& drives);

}  // namespace rollrig::tools
