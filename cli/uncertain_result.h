#pragma once
/// Results whose uncertainty is asked for on the command line.

#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/uncertainty_options.h"

namespace rollrig::cli {

/// The result of `make`, which gets what is asked of the uncertainty and shows its progress. A test report has the
/// budget wherever there can be one.
template <class Make>
auto make_uncertain(const char* label, const OutputOptions& output, UncertaintyOptions uncertainty, const Make& make) {
  uncertainty.budget_if_any = !output.report.empty();
  ProgressLine progress(label, output.quiet);
  return make(uncertainty, progress.callback());
}

}  // namespace rollrig::cli
