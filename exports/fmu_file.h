#pragma once
/// A wheel as FMU: docs/fmu.md.

#include <string>

#include "fmu/wheel_model.h"

namespace rollrig::exports {

/// A tire or a rig: its name, and the file that has it.
struct NamedFile {
  std::string name;
  std::string path;
};

/// The bytes of the FMU: description, the shared object of this machine with the wheel in it, and the file of the tire
/// beside it, which no importer needs. The same input gives the same bytes.
/// Errors   InputError: the model is too large; a name with control characters
/// Checked  tests/fmu/fmu_file_test.cpp
std::string make_fmu_file(const fmu::WheelModel& model, const NamedFile& tire, const NamedFile& rig, int fmi_version);

}  // namespace rollrig::exports
