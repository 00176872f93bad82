// The ten lines in the terminal: what they say, and that they fit.
#include "diagnosis/output/summary.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "build_paths.h"
#include "sim/core/text.h"
#include "tests/diagnosis/hand_made.h"
#include "tests/support/temporary_folder.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::Diagnosis;
using diagnosis::format_summary;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void check_layout(const std::string& text, std::size_t lines) {
  INFO(text);
  CHECK(lines_of(text).size() == lines);
  for (const std::string& line : lines_of(text)) {
    CHECK(count_characters(line) <= 80);
    CHECK(line.find_last_not_of(' ') == line.size() - 1);
  }
}

/// The text as one line, each run of spaces and line ends a single space.
std::string join_lines(const std::string& text) {
  std::istringstream in(text);
  std::string joined;
  for (std::string word; in >> word;) joined += word + " ";
  return joined;
}

/// The line that starts with a label.
std::string line_of(const std::string& text, const std::string& label) {
  for (const std::string& line : lines_of(text)) {
    if (line.rfind(label, 0) == 0) return line;
  }
  return {};
}

}  // namespace

TEST_CASE("an explained gap is told in ten lines, some of them continued, and below them what N of a torque are",
          "[fast]") {
  const std::string text = format_summary(tests::make_explained());
  check_layout(text, 15);
  CHECK_THAT(lines_of(text).back(), Catch::StartsWith("Torque") && Contains("in N, as force at the drum's surface"));
  CHECK_THAT(line_of(text, "Verdict"), Contains("explained") && Contains("94 %") && Contains("3 %"));
  CHECK_THAT(line_of(text, "Cause"),
             Contains("bearing_warmup") && Contains("0.0192 1/K") && Contains("0.0153 to 0.0231"));
  CHECK_THAT(text, Contains("The rig's bearings warm"));
  CHECK_THAT(line_of(text, "Where"), Contains("torque in transient-skim, skim 1") && Contains("+1.9 N") &&
                                         Contains("z 14.2") && Contains("41 %"));
  CHECK_THAT(line_of(text, "Equation"), Contains("drum torque 88 %"));
  CHECK_THAT(line_of(text, "Gap"), Contains("6.1 noise floors") && Contains("2.3 recalibrated") && Contains("0.2"));
  CHECK_THAT(line_of(text, "  in units"), Contains("torque 1.9->0.13 N") && Contains("liner 0.40->0.10 degC") &&
                                              Contains("pressure 0.30->0.10 kPa"));
  CHECK_THAT(line_of(text, "Shrinks by"),
             Contains("91 %") && Contains("84 to 96") && Contains("3 held out") && Contains("black box 70 %"));
  CHECK_THAT(line_of(text, "  else"),
             Contains("93 % (88 to 97) on stretches,") && Contains("95 % (92 to 98) on fitted data"));
  CHECK_THAT(line_of(text, "  energy"), Contains("off by 2.1 %") && Contains("with the cause by 0.14 %"));
  CHECK_THAT(line_of(text, "Not excluded"), Contains("windage, torque_gain"));
  CHECK_THAT(line_of(text, "Next test"), Contains("drum alone"));
}

TEST_CASE("no gap is ten lines too, without a cause or a shrinkage", "[fast]") {
  const std::string text = format_summary(tests::make_no_gap());
  check_layout(text, 10);
  CHECK_THAT(line_of(text, "Verdict"), Contains("no gap") && Contains("98 %"));
  CHECK_THAT(line_of(text, "Cause"), Contains("none needed"));
  CHECK_THAT(line_of(text, "Where"), Contains("nowhere"));
  CHECK_THAT(line_of(text, "Shrinks by"), Contains("nothing above the noise"));
}

TEST_CASE("a shrinkage of one run alone is one of its stretches", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.gap.held_out.clear();
  made.gap.judged_on.clear();
  made.gap.runs.reset();
  made.gap.judged_by = diagnosis::JudgedBy::kStretches;
  made.gap.shrink_percent = 93.0;
  made.gap.shrink_ci95_percent = {88.0, 97.0};
  const std::string text = format_summary(made);
  CHECK_THAT(line_of(text, "Shrinks by"), Contains("93 % (88 to 97) on stretches held out"));
  CHECK_THAT(line_of(text, "  else"), Contains("on fitted data") && !Contains("stretches"));
  CHECK_THAT(line_of(text, "  energy"), Contains("1.9 %"));
}

TEST_CASE("runs that cannot be judged are named, with what they alone hold", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.gap.not_judged = {{"load-sweep", {"load", "speed"}}};
  CHECK_THAT(join_lines(format_summary(made)),
             Contains("Not judged load-sweep (alone in load, speed): cannot be judged without it "));
  made.gap.not_judged.push_back({"warm-up-40", {}});
  CHECK_THAT(join_lines(format_summary(made)),
             Contains("load-sweep (alone in load, speed), warm-up-40: cannot be judged without them "));
}

TEST_CASE("a trace is told with its size, its probability, and that it does not matter", "[fast]") {
  Diagnosis made = tests::make_no_gap();
  made.trace = tests::make_trace();
  const std::string text = format_summary(made);
  CHECK_THAT(line_of(text, "Verdict"), Contains("no gap that matters, probability 98 %"));
  CHECK_THAT(join_lines(text),
             Contains("a trace of torque_gain: gain -0.06 % (95 %: -0.1 to -0.02), too small to matter "
                      "(0.07 % of the energy, 0.12 noise floors); probability 92 %"));
}

TEST_CASE("the summary says how likely the cause acts alone, and what else may act", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].acts = 0.98;
  made.causes[0].alone = 0.9;
  CHECK(format_summary(made).find("acts 98 %") == std::string::npos);  // no partner is worth telling
  made.causes[0].partners = {{"slow_leak", 0.05}, {"rim_heat", 0.03}};
  CHECK_THAT(join_lines(format_summary(made)),
             Contains("alone acts 98 %, alone 90 %; else with slow_leak 5 %, rim_heat 3 %"));
  check_layout(format_summary(made), 16);
  SECTION("with an alternative, that it or the other is all") {
    made.causes[0].indistinguishable_from = {"torque_zero_drift"};
    made.causes[0].complete = 0.93;
    CHECK_THAT(join_lines(format_summary(made)),
               Contains("one of these and nothing else 93 %; else with slow_leak 5 %"));
  }
  made.verdict = diagnosis::Verdict::kNoGap;
  CHECK(format_summary(made).find("acts 98 %") == std::string::npos);
}

TEST_CASE("an unusual companion is told beside the cause that it leaves", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.verdict = diagnosis::Verdict::kUnexplained;
  made.causes[0].companions = {"power of slip_loss would have to be 4, 3.2 standard deviations from what is usual"};
  const std::string text = join_lines(format_summary(made));
  CHECK_THAT(text, Contains("looks like this cause, but something else is missing"));
  CHECK_THAT(text, Contains("power of slip_loss would have to be 4"));
}

TEST_CASE("what cannot be told apart stands beside the cause", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].indistinguishable_from = {"tire_loss_in_skim", "torque_zero_drift"};
  const std::string text = format_summary(made);
  check_layout(text, 14);
  CHECK_THAT(line_of(text, "or as well"), Contains("tire_loss_in_skim, torque_zero_drift") && Contains("cannot tell"));
}

TEST_CASE("two effects together both show their size", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].effects = {"bearing_warmup", "slow_leak"};
  made.causes[0].parameters = {{"bearing_warmup.fall_per_K", 0.02, 0.0, 0.01, 0.03, "1/K"},
                               {"slow_leak.rate_kPa_per_h", 1.0, 0.1, 0.8, 1.2, "kPa/h"}};
  CHECK_THAT(line_of(format_summary(made), "Cause"), Contains("fall 0.02 1/K (95 %: 0.01 to 0.03)"));
  made.probability["slow_leak"] = 0.61;
  CHECK_THAT(line_of(format_summary(made), "  with"), Contains("slow_leak (61 %): rate 1 kPa/h (95 %: 0.8 to 1.2)"));
  check_layout(format_summary(made), 14);
}

TEST_CASE("what cannot be told from two effects stands below", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].effects = {"bearing_warmup", "slow_leak"};
  made.causes[0].indistinguishable_from = {"rim_heat"};
  CHECK_THAT(line_of(format_summary(made), "Or as well"),
             Contains("rim_heat in place of one or more of them (this set cannot tell)"));
  check_layout(format_summary(made), 15);
}

TEST_CASE("an inadequate cause is not sold as an explanation", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.verdict = diagnosis::Verdict::kUnexplained;
  made.causes[0].adequate = false;
  made.causes[0].objections = {"the size differs from run to run: 0.01 to 0.04 1/K"};
  const std::string text = format_summary(made);
  check_layout(text, 16);
  CHECK_THAT(line_of(text, "Verdict"), Contains("looks like this cause, but something else is missing"));
  CHECK_THAT(line_of(text, "But"), Contains("differs from run to run"));
}

TEST_CASE("an unknown cause is said to be one", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.verdict = diagnosis::Verdict::kUnexplained;
  made.probability["unknown"] = 0.9;
  made.causes.clear();
  const std::string text = format_summary(made);
  check_layout(text, 12);
  CHECK_THAT(line_of(text, "Verdict"), Contains("outside the catalog") && Contains("90 %"));
  CHECK_THAT(line_of(text, "Cause"), Contains("none of the catalog"));
}

TEST_CASE("where nothing left out can judge the cause, that is said", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.gap.shrink_percent.reset();
  made.gap.judged_on.clear();
  made.gap.runs.reset();
  made.gap.stretches.reset();
  made.gap.judged_by = diagnosis::JudgedBy::kNothing;
  CHECK_THAT(line_of(format_summary(made), "Shrinks by"), Contains("unknown: nothing can judge it"));
  CHECK_THAT(line_of(format_summary(made), "  else"), Contains("95 % (92 to 98) on fitted data"));
  check_layout(format_summary(made), 14);
}

TEST_CASE("an estimate on the limit of its range is marked", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].effects = {"brake_drag"};
  made.causes[0].parameters = {{"brake_drag.force_N", 100.0, 9.0, 72.3, 100.0, "N"}};
  CHECK_THAT(join_lines(format_summary(made)), !Contains("limit of its range"));
  made.causes[0].parameters[0].on_limit = RangeLimit::kUpper;
  CHECK_THAT(join_lines(format_summary(made)),
             Contains("brake_drag: force 100 N (95 %: 72.3 to 100), on the limit of its range"));
}

TEST_CASE("the numbers of the files that moved furthest are named, and the uncertainties that are assumed", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.base_numbers = {
      {"thermal.conductance_at_rest_W_per_K", "W/K", 12.0, 1.0, SdSource::kUsual, 15.1, 3.1, 14.4, 2.4},
      {"rolling_resistance.A0_N", "N", 36.0, 0.7, SdSource::kFile, 35.0, -1.4, 34.9, -1.6},
      {"parasitic.c0_N", "N", 6.0, 0.3, SdSource::kUsual, 6.1, 0.3, 6.0, 0.1}};
  const std::string text = format_summary(made);
  check_layout(text, 17);
  CHECK_THAT(line_of(text, "Moved"),
             Contains("conductance_at_rest_W_per_K +2.4 sd, A0_N -1.6 sd with the cause") && !Contains("c0_N"));
  CHECK_THAT(line_of(text, "Assumed"),
             Contains("no _sd") && Contains("conductance_at_rest_W_per_K 8.3 %") && !Contains("A0_N"));
  made.base_numbers[0].sd_source = SdSource::kClass;
  CHECK_THAT(line_of(format_summary(made), "Assumed"), Contains("class values"));
  for (BaseNumber& base : made.base_numbers) {
    base.with_cause.reset();
    base.with_cause_moved_sd.reset();
    base.moved_sd *= 0.1;
    base.sd_source = SdSource::kFile;
  }
  CHECK_THAT(line_of(format_summary(made), "Moved"), Contains("no number of the files by more than 1"));
  CHECK(line_of(format_summary(made), "Assumed").empty());
}

TEST_CASE("files in doubt are told of before any physics, once", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.verdict = diagnosis::Verdict::kUnexplained;
  made.causes.clear();
  made.doubt = "in run 2 it looks as if cavity_pressure_kPa were in bar: no cause is named until that is corrected";
  made.warnings = {"there is one run only", made.doubt};
  const std::vector<std::string> lines = lines_of(format_summary(made));
  CHECK_THAT(lines.at(0), Contains("Verdict") && Contains("files are in doubt"));
  CHECK_THAT(lines.at(2), Contains("looks as if cavity_pressure_kPa were in bar"));
  const std::string text = format_summary(made);
  CHECK(text.find("were in bar") == text.rfind("were in bar"));
  CHECK_THAT(text, Contains("there is one run only"));
}

TEST_CASE("warnings follow in full, and long names stay within 80 columns", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.set = std::string(120, 'x');
  made.where[0].run = "a-run-with-a-name-that-goes-on-and-on-beyond-all-that-is-reasonable-2026-11-21";
  made.where[0].phase = "the third skim of the second repetition";
  for (int i = 0; i < 30; ++i) made.not_excluded.push_back("effect_" + std::to_string(i));
  const std::string warning =
      "liner_temperature_degC of run 1-warm-up-80 stands at 25.4 degC from 0 to 2040 s, where it should move by 16: a "
      "stuck sensor? Those samples are left out";
  made.warnings = {warning};
  const std::string text = format_summary(made);
  for (const std::string& line : lines_of(text)) CHECK(count_characters(line) <= 80);
  CHECK_THAT(text, Contains("repetition") && Contains("14.2") && !Contains("..."));
  CHECK_THAT(line_of(text, "Not excluded"), Contains(" more"));
  std::string flat;
  for (const std::string& line : lines_of(text.substr(text.find("Warning")))) flat += line.substr(14) + " ";
  CHECK_THAT(flat, Contains(warning));
}

TEST_CASE("a probability is never rounded to certainty", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].probability = 0.9999;
  made.probability["none"] = 1e-9;
  CHECK_THAT(line_of(format_summary(made), "Verdict"), Contains("over 99 %") && Contains("under 1 %"));
}

TEST_CASE("docs/diagnosis.md shows the summary as it is printed", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.causes[0].indistinguishable_from = {"tire_loss_in_skim"};
  const std::string page = tests::read_file(ROLLRIG_SOURCE_DIR "/docs/diagnosis.md");
  for (const std::string& line : lines_of(format_summary(made))) CHECK_THAT(page, Contains("    " + line + "\n"));
}

TEST_CASE("what was left out is told to be likelier with the cause by a factor, or beyond all doubt", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.gap.left_out_nats = std::log(42.0);
  CHECK_THAT(join_lines(format_summary(made)),
             Contains("runs and numbers of the files") && Contains("42 times likelier"));
  made.gap.left_out_nats = 0.5;
  CHECK_THAT(join_lines(format_summary(made)), Contains("1.6 times likelier"));
  made.gap.left_out_nats = 900.0;
  CHECK_THAT(join_lines(format_summary(made)), Contains("over a million times"));
  made.gap.left_out_nats.reset();
  CHECK(format_summary(made).find("  predicted") == std::string::npos);
}

TEST_CASE("without a gap the probability is that of nothing to be seen, beside that of nothing at all", "[fast]") {
  Diagnosis made = tests::make_no_gap();
  made.nothing_detectable = 0.99;
  made.probability["none"] = 0.61;
  CHECK_THAT(line_of(format_summary(made), "Verdict"), Contains("probability 99 % (no effect at all 61 %)"));
}

TEST_CASE("an effect outside the catalog is described where it is the verdict, and not elsewhere", "[fast]") {
  Diagnosis made = tests::make_explained();
  made.unknown_like = diagnosis::Likeness{"a force of +18 N that acts between 62 and 78 km/h", 0.94, {"slip_loss"}};
  CHECK(format_summary(made).find("It is like") == std::string::npos);
  made.verdict = diagnosis::Verdict::kUnexplained;
  const std::string text = join_lines(format_summary(made));
  CHECK_THAT(text, Contains("It is like a force of +18 N that acts between 62 and 78 km/h, beside slip_loss (94 %)"));
}
