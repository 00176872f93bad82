#include <fmt/format.h>

#include "api/data.h"
#include "api/option_range.h"
#include "diagnosis/checks/set_checks.h"
#include "measurements/run_rows.h"
#include "report/fit_pages.h"
#include "rollrig/fit.h"

namespace rollrig {
namespace {

/// A fit follows whatever the columns say, so a suspicion that they say another thing is told beside its numbers, or
/// beside the error that comes of it.
estimation::TireFit fit_checked(const measurements::MeasurementSet& set, const TireFitOptions& options,
                                const std::string& suspicion) {
  try {
    estimation::TireFit fit = estimation::fit_tire(set, options);
    if (!suspicion.empty()) fit.warnings.push_back(suspicion + ". Then the fitted numbers are wrong");
    return fit;
  } catch (const RunFailure& failure) {
    if (suspicion.empty()) throw;
    throw RunFailure(fmt::format("{}; {}", failure.what(), suspicion));
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (!suspicion.empty()) problem.what += "; " + suspicion;
    throw InputError(problem);
  }
}

}  // namespace

TireFit fit_tire(const MeasurementSet& measured, const TireFitOptions& options) {
  require_threads(options.threads);
  const diagnosis::SetChecks checks = diagnosis::check_set(measured.data().set, options.threads);
  const auto set =
      std::make_shared<const measurements::MeasurementSet>(diagnosis::leave_out(measured.data().set, checks.left_out));
  const auto fit = std::make_shared<estimation::TireFit>(fit_checked(*set, options, checks.suspicion));
  if (!checks.left_out.empty()) {
    fit->warnings.emplace_back(
        "samples of stuck sensors or that stand alone were left out: rollrig validate tells which");
  }
  const std::vector<std::string> bad_rows = measurements::describe_bad_rows(*set);
  fit->warnings.insert(fit->warnings.end(), bad_rows.begin(), bad_rows.end());
  fit->tire.name = options.name.empty() ? set->tire.name + "_fit" : options.name;
  TireFit result;
  result.parameters = estimation::list_parameters(*fit);
  result.warnings = fit->warnings;
  result.suspicion = checks.suspicion;
  result.text = fmt::format("fit tire   set {}   tire {}   rig {}\n", set->name, set->tire.name, set->rig->name) +
                format_tables(report::make_tire_fit_tables(*fit)) + format_warnings(fit->warnings);
  Json json = estimation::make_fit_json(*set, *fit);
  json["bad_rows"] = measurements::make_bad_rows_json(*set);
  result.json = to_text(json);
  result.make_files = [fit, json = result.json] {
    return FolderFiles{{fit->tire.name + ".toml", models::write_tire(fit->tire, fit->notes)}, {"fit.json", json}};
  };
  result.make_page = [set, fit] { return report::make_html(report::make_tire_fit_page(*set, *fit)); };
  return result;
}

}  // namespace rollrig
