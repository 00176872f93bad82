#pragma once
/// HDF5: groups, data sets and the attribute `unit`. The only place of the project that knows the library.

#include <string>

#include "exports/tree.h"

namespace rollrig::exports {

/// The bytes of an HDF5 file (readable since library 1.8). A Group is a group, its members in order; a Column a data
/// set of doubles, long ones deflated; Texts a data set of strings in UTF-8; a flag h5py's enumeration of FALSE and
/// TRUE; a List a group whose members are named by their place, from 0. Every number whose name says a unit has the
/// attribute `unit`. '/' in a name becomes '_'. The same tree gives the same bytes.
/// Checked  tests/exports/hdf5_file_test.cpp
std::string make_hdf5(const Group& tree);

}  // namespace rollrig::exports
