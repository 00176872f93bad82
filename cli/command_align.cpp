#include <fmt/format.h>

#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/uncertain_result.h"
#include "rollrig/align.h"

namespace rollrig::cli {
namespace {

constexpr const char* kOfApply =
    "--rrc, --class, --measurements, --on, --uncertainty, --monte-carlo, --seed, --threads, --json, --quiet";

struct AlignOptions {
  AlignmentInput input;
  std::vector<double> reference;
  AlignedValueInput value;
  OutputOptions output;
  UncertaintyOptions uncertainty;
};

int align_command(const AlignOptions& options) {
  AlignmentInput input = options.input;
  if (!options.reference.empty()) input.reference = std::pair(options.reference[0], options.reference[1]);
  Output output(options.output);
  const Alignment alignment = make_uncertain("align", options.output, options.uncertainty,
                                             [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
                                               return align(input, uncertainty, progress);
                                             });
  output.show(alignment);
  return alignment.is_valid ? kDone : kDiffers;
}

int apply_command(const AlignOptions& options) {
  const AlignmentInput& fit = options.input;
  for (const auto& [option, value] :
       {std::pair("--out", options.output.folder), std::pair("--html", options.output.html),
        std::pair("--report", options.output.report), std::pair("--machine", fit.machine),
        std::pair("--reference-machine", fit.reference_machine), std::pair("--reference-values", fit.reference_values),
        std::pair("--machine-changed", fit.machine_changed)}) {
    if (!value.empty()) throw usage_error(fmt::format("--apply does not take {}", option), option, value, kOfApply);
  }
  for (const auto& [option, is_given] :
       {std::pair("--reference", !options.reference.empty()), std::pair("--preliminary", fit.preliminary),
        std::pair("--first-excluded", fit.first_excluded)}) {
    if (is_given) throw usage_error(fmt::format("--apply does not take {}", option), option, "", kOfApply);
  }
  Output output(options.output);
  AlignedValueInput value = options.value;
  value.on = fit.on;
  const AlignedValue aligned = make_uncertain("align", options.output, options.uncertainty,
                                              [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
                                                return apply_alignment(value, uncertainty, progress);
                                              });
  output.show(aligned);
  return aligned.is_valid ? kDone : kDiffers;
}

int align_or_apply(const AlignOptions& options) {
  const bool is_value = !options.value.alignment.empty();
  if (is_value == !options.input.file.empty()) {
    throw usage_error(is_value ? "a file to fit and --apply exclude each other" : "nothing to fit or to apply",
                      is_value ? "--apply" : "file", "",
                      "a CSV file of measurements, or --apply <alignment.json> with --rrc <N/kN>");
  }
  return is_value ? apply_command(options) : align_command(options);
}

}  // namespace

void add_align_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<AlignOptions>(
      app, action, "align", "Align a machine to a reference machine, as for the EU tire label", &align_or_apply);
  AlignmentInput& input = options->input;
  command->add_option("file", input.file, "Measurements of alignment and control tires (.csv)");
  command->add_option("--machine", input.machine, "Candidate machine, where the file has several");
  command->add_option("--reference-machine", input.reference_machine, "Machine of the file that is the reference");
  command->add_option("--reference-values", input.reference_values,
                      "Values of the reference laboratory, a row for each tire (.csv)");
  command->add_option("--reference", options->reference, "A1, and B1 in N/kN, of the reference laboratory [1 0]")
      ->expected(2)
      ->type_name("A1 B1");
  command->add_flag("--preliminary", input.preliminary,
                    "Compute an alignment that breaks rules as well; it is not valid");
  command->add_flag("--first-excluded", input.first_excluded,
                    "The file already omits the first measurement of each tire, which is not used");
  command->add_option("--on", input.on,
                      "Day on which validity is judged [day of the last row, or of --machine-changed if later; with "
                      "--apply: today]");
  command->add_option("--machine-changed", input.machine_changed, "Day of the last significant change of the machine");
  CLI::Option* apply = command->add_option("--apply", options->value.alignment, "Alignment (.json) to apply to --rrc");
  CLI::Option* rrc =
      command->add_option("--rrc", options->value.rrc_N_per_kN, "Measured value in N/kN, at 25 degC, 2 m drum");
  apply->needs(rrc);
  rrc->needs(apply);
  command->add_option("--class", options->value.tire_class, "Tire class of --rrc: C1, C2 or C3 [not checked]")
      ->needs(apply);
  command->add_option("--measurements", options->value.measurements, "Measurements whose mean --rrc is [1]")
      ->needs(apply);
  options->output.add_to(*command, "File for the alignment, - for standard output",
                         "Folder for alignment.json, measurements.csv");
  options->output.add_report_to(*command);
  add_uncertainty_options(*command, options->uncertainty, true);
}

}  // namespace rollrig::cli
