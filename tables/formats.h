#pragma once
/// Readers of the single formats. All throw InputError for a file that is damaged or holds what they do not read; a
/// file without columns gives none.
/// Checked  tests/tables

#include <string>

#include "tables/columns.h"

namespace rollrig::tables {

/// A MATLAB file of version 5, 6 or 7: vectors, matrices, structs of them (also nested), struct arrays of single
/// values, cells of texts. A struct's field `units` with a text for a field has that field's unit. Objects of MATLAB
/// (table, timetable, datetime) are not read.
Columns read_mat(const std::string& path);

/// An HDF5 file: data sets of one or two dimensions, of numbers or texts, and of records, whose members are columns. An
/// attribute `unit` or `units` of a data set is its unit. Files of MATLAB 7.3 and of Octave have the names as there.
Columns read_hdf5(const std::string& path);

/// An MDF4 file (ASAM MDF 4.x): channels of numbers of sorted and unsorted groups, plain or compressed with zlib, with
/// linear conversions. Channels of texts and arrays, and those with other conversions, are named without rows. The name
/// of a channel that several groups have begins with the number of its group: "2/time".
/// Errors   InputError, also for a file with attachments, and one that is not finalized
/// Source   public descriptions of ASAM MDF 4.1
Columns read_mdf4(const std::string& path);

}  // namespace rollrig::tables
