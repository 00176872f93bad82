#pragma once
/// Rows of the file of an alignment.

#include <optional>
#include <string>
#include <vector>

#include "sim/core/csv.h"

namespace rollrig::estimation {

/// One measurement: RRc at 25 degC and for the 2 m drum.
struct AlignmentMeasurement {
  double time_s = 0.0;  // since 1970-01-01, on the laboratory's clock
  double rrc_N_per_kN = 0.0;
  bool is_used = true;        // the first one of a tire on a machine is not
  bool is_day_alone = false;  // the file says no time of day
};

struct AlignmentRow {
  std::size_t row = 0;
  std::string tire, tire_class, machine;
  bool is_control = false;
  AlignmentMeasurement measurement;
  std::optional<double> reference_N_per_kN;
};

inline constexpr const char* kRrcColumn = "rrc_N_per_kN";
inline constexpr const char* kRrcPerTonneColumn = "rrc_kg_per_t";
inline constexpr const char* kReferenceColumn = "reference_N_per_kN";
inline constexpr const char* kAssignedColumn = "assigned_N_per_kN";

/// Values of rolling resistance that are no mistake of the unit. Assumed: tires of cars to trucks have 3 to 15 N/kN.
inline constexpr double kLeastRrc_N_per_kN = 1.5;
inline constexpr double kMostRrc_N_per_kN = 30.0;
/// What a value outside may be.
std::string guess_unit(double rrc_N_per_kN);

/// All rows, each by itself without a mistake.
/// Errors  InputError: an unknown or missing column; a wrong class, date, use or value; two measurements of a tire on a
///         machine at one time; a value that is far from the others of its tire
std::vector<AlignmentRow> read_alignment_rows(const CsvTable& table);

/// A value of a cell. Throws InputError.
double read_rrc(const CsvTable& table, std::size_t row, const std::string& column, const std::string& text);
/// The column of the values to be aligned to; empty where there is none. Throws InputError where there are two.
std::string find_reference_column(const CsvTable& table);

/// A day, "2026-03-02", as seconds since 1970-01-01. Throws InputError that names the option.
double read_day_s(const std::string& text, const std::string& option);

}  // namespace rollrig::estimation
