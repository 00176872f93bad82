#pragma once
/// What is not likely in the measurements of an alignment, though no rule forbids it.

#include <string>
#include <vector>

#include "estimation/alignment/alignment_file.h"
#include "estimation/alignment/line_fit.h"

namespace rollrig::estimation {

/// A sentence for each doubt of the measured values. All used values of each tire on a machine are equal. Nearly all
/// used values of the candidate stand among those of the same tire on the reference machine. All tires have the values
/// of an earlier round, or of an earlier day, of the same machine. A tire has the values of another one on a machine.
/// The mean RRc of the tires of a class is not one of the class, as models::doubt_class_by_mean() says. Coarse values
/// are equal by chance. A copy is therefore doubted only where chance would hardly make it, as the other equal values
/// of the tires show.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_value_doubts(const AlignmentFile& file);

/// A sentence for each doubt of the line. The tires lie much nearer to it than the scatter of the repeats makes likely:
/// the values of one machine were computed from the other's. So they are where the measurements of both machines scatter together,
/// paired by their order; both only where the values are fine enough. Nearly all values of the reference are the
/// candidate's own means, rounded as they are.
/// `repeats`: scatter of the means without the rounding of the values, which is no scatter.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_line_doubts(const AlignmentFile& file, const LineFit& fit, const RepeatScatter& repeats);

/// A sentence for each doubt of the times: on one machine, two measurements of a tire that are nearer than soak and
/// warm-up of its class (find_iso_test() for the least load index, by which a class has the shortest warm-up), or two
/// of different tires that are nearer than the warm-up; more than a year between the two machines. A time of 0:00 is
/// that of a day alone.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_time_doubts(const AlignmentFile& file);

/// What is to be said where all values of a tire, or of each of several, are equal. A step of at least 0.05 N/kN may be
/// too coarse to show the scatter. `values`: of the machine, for the step. Assumed: this limit, of the order of sigma_m
std::string describe_equal_values(const std::string& subject, const std::vector<double>& values);

/// A sentence where measurements are dated after `today`, "2026-11-29" in UTC. One day more is allowed, because the
/// clock of a laboratory may be ahead of UTC.
/// Checked   tests/estimation/alignment_test.cpp
std::vector<std::string> list_date_doubts(const AlignmentFile& file, const std::string& today);

}  // namespace rollrig::estimation
