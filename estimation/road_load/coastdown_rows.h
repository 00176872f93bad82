#pragma once
/// Rows of a file of coastdowns, sorted into runs.

#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/run_checks/checked_rows.h"

namespace rollrig::estimation {

/// Weather and road of all rows of a file.
CoastdownConditions read_conditions(CheckedRows& rows);
/// The columns that read_conditions() reads.
std::vector<std::string> list_condition_columns();
void add_conditions(const CoastdownConditions& of_rows, std::size_t row, CoastdownConditions& to);

/// Cells of an optional column; empty strings where it is absent.
std::vector<std::string> text_or_empty(const CsvTable& table, const std::string& column);

/// Throws InputError where an optional column `vehicle` names more than one.
void require_one_vehicle(const CsvTable& table);

/// The rows of one run that can be used, in the order of the file.
struct RowsOfRun {
  std::string id;
  std::string session;
  int heading = 0;
  std::vector<std::size_t> rows;
};

/// Sorts rows by the columns `run` and `session` (else `file`, else `test_date`), in the order in which the runs begin.
/// `begins` tells where a new run begins if the file has no `run` column; rows that are not among `used` are passed
/// over. A row whose heading is none, or differs from that of most rows of its run, is noted as bad.
std::vector<RowsOfRun> sort_into_runs(CheckedRows& rows, const std::vector<bool>& begins,
                                      const std::vector<bool>& used);

}  // namespace rollrig::estimation
