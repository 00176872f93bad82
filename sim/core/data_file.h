#pragma once
/// Files of measured data that another file names.

#include <string>

#include "sim/core/schema.h"

namespace rollrig {

/// Path of a data file that `key` of a set names, in `folder` or below it: a set from somewhere else reads
/// no other file of this machine. Tires, rigs, vehicles and sensors may lie elsewhere (find_asset_of()), and the
/// logs of a mapping.
/// Errors    InputError: an absolute path, or one that leads out of the folder
/// Validity  by the name alone; a link in the folder is followed
/// Checked   tests/measurements/measurement_set_test.cpp
std::string place_data_file(const TableReader& reader, const std::string& key, const std::string& folder,
                            const std::string& name);

}  // namespace rollrig
