#pragma once
/// A wheel as FMU: docs/fmu.md.

#include <string>

#include "fmu/wheel_model.h"

namespace rollrig::exports {

/// The bytes of the FMU: description, the shared object of this machine with the wheel in it, and the file of the tire
/// beside it, which no importer needs. The same input gives the same bytes.
/// Errors   InputError: the model is too large
/// Checked  tests/fmu/fmu_file_test.cpp
std::string make_fmu_file(const fmu::WheelModel& model, const std::string& rig, const std::string& tire_toml,
                          int fmi_version);

}  // namespace rollrig::exports
