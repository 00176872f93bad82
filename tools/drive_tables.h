#pragma once
/// The drive-cycle part of docs/published.md.

#include <map>

#include "tools/joint_calibration.h"
#include "tools/pages.h"
#include "tools/tire_drive.h"

namespace rollrig::tools {

/// The source's test driven on each tire, by its name.
using Drives = std::map<std::string, TireDrive>;
using Observations = std::vector<joint::Observation>;

/// The published number and the virtual one of this name. Throws RunFailure without it.
const joint::Observation& find_observation(const Observations& all, const std::string& name);

/// Tables 4.4 and 4.5.
Rows list_sections(const Observations& all);
/// Figure 3.13: a50 with its coefficients, a row for each heat capacity, and the conductances fitted to each.
std::pair<Rows, Rows> list_figure_3_13();
Rows list_table_5_1(const Observations& all);
Rows list_table_4_2(const Observations& all);
/// What §4.3.1, §4.4.1 and §4.4.3 say in words on temperature and RRc: holds or not, by how much.
Rows list_statements(const Drives& drives);

}  // namespace rollrig::tools
