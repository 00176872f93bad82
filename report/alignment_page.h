#pragma once
/// The tables of `rollrig align` for terminal and page, its page, and its certificate.

#include <vector>

#include "estimation/alignment/alignment.h"
#include "report/page.h"
#include "report/test_report.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Equation and validity, tires, aligned values with their uncertainty, checks, control tires.
std::vector<Table> make_alignment_tables(const estimation::AlignmentFile& file,
                                         const estimation::AlignmentResult& result);

/// "valid on 2026-02-09", and what it lacks.
std::string describe_alignment_verdict(const estimation::AlignmentResult& result);

/// The chart of each control tire and their drift; none where there are no control tires.
std::vector<Table> make_control_tire_tables(const estimation::AlignmentResult& result);

/// These tables, the line, residuals, control tires over time.
Page make_alignment_page(const estimation::AlignmentFile& file, const estimation::AlignmentResult& result);

/// The certificate to print, with the numbers of its JSON.
TestReport make_alignment_report(const estimation::AlignmentFile& file, const estimation::AlignmentResult& result,
                                 const Json& json, const std::vector<ReportFile>& files);

/// An aligned value and the contributions to its uncertainty.
std::vector<Table> make_aligned_value_tables(double measured_N_per_kN, int measurements,
                                             const estimation::UncertainValue& aligned);

}  // namespace rollrig::report
