#include "rollrig/diagnose.h"

#include "api/data.h"
#include "api/fleet_items.h"
#include "api/option_range.h"
#include "diagnosis/next_test/plan_files.h"
#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/explain.h"
#include "diagnosis/output/fleet.h"
#include "diagnosis/output/summary.h"
#include "diagnosis/terms/term.h"
#include "measurements/run_rows.h"
#include "report/diagnosis_page.h"
#include "report/set_comparison.h"
#include "rollrig/version.h"

namespace rollrig {
namespace {

void require_valid(const DiagnosisOptions& options) {
  require_comparable_effects(options.only, options.without);
  require_threads(options.threads);
}

}  // namespace

Diagnosis diagnose(const MeasurementSet& set, const DiagnosisOptions& options) {
  require_valid(options);
  const auto found = std::make_shared<const diagnosis::Diagnosis>(diagnosis::diagnose(set.data().set, options));
  Diagnosis result;
  static_cast<Findings&>(result) = *found;
  result.text = diagnosis::format_summary(*found);
  Json json = diagnosis::make_diagnosis_json(*found);
  json["phase_means"] = report::list_phase_means(set.data().set);
  json["bad_rows"] = measurements::make_bad_rows_json(set.data().set);
  result.json = to_text(json);
  result.make_page = [set, found] { return report::make_html(report::make_diagnosis_page(set.data().set, *found)); };
  result.make_plan = [set, found] { return to_folder(diagnosis::write_plan(set.data().set, *found)); };
  return result;
}

FleetDiagnosis diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options,
                              BadRows bad_rows) {
  if (folders.empty())
    throw InputError({"there is no set to diagnose", "", 0, "", "", "the folder of one set at least", ""});
  require_valid(options);
  const FleetItems items(folders, options, bad_rows);
  const campaigns::CampaignFolder nowhere{"", library_version(), 0};  // the results go into no file
  campaigns::carry_out_all(items, nowhere, options.threads, [](const campaigns::Record&) {});
  const auto fleet = std::make_shared<const diagnosis::Fleet>(items.make_fleet());
  FleetDiagnosis result;
  result.members = fleet->members;
  result.text = diagnosis::format_fleet(*fleet);
  result.json = to_text(diagnosis::make_fleet_json(*fleet));
  result.make_page = [fleet] { return report::make_html(report::make_fleet_page(*fleet)); };
  return result;
}

std::string explain_effect(const std::string& name) { return diagnosis::explain_effect(name); }

std::vector<std::string> explainable_names() { return diagnosis::explainable_names(); }

std::vector<std::string> comparable_names() { return diagnosis::term_names(); }

}  // namespace rollrig
