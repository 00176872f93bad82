#pragma once
/// modelDescription.xml of an FMU.

#include <string>
#include <vector>

#include "fmu/warm_wheel.h"

namespace rollrig::exports {

constexpr const char* kFmuIdentifier = "rollrig_tire";  // of the shared object

struct FmuDescription {
  int fmi_version = 2;  // or 3
  std::string name;
  std::string description;
  std::string tool;   // that made it
  std::string token;  // by which importer and FMU know each other
};

/// Source  FMI 2.0 and 3.0, schema fmi2ModelDescription.xsd and fmi3ModelDescription.xsd
/// Checked tests/fmu/fmu_file_test.cpp
std::string make_model_description(const FmuDescription& about, const std::vector<fmu::Variable>& variables);

}  // namespace rollrig::exports
