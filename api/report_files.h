#pragma once
/// The files that went into a result, as a test report lists them.

#include <functional>
#include <string>
#include <vector>

#include "report/test_report.h"
#include "sim/core/file_io.h"

namespace rollrig {

/// Every file that was read since the recorder was made, with its SHA-256. `find_role` says what a file was read for.
std::vector<report::ReportFile> list_report_files(const ReadRecorder& recorder,
                                                  const std::function<std::string(const std::string&)>& find_role);

}  // namespace rollrig
