#include "rollrig/loop.h"

#include "api/data.h"
#include "api/option_range.h"
#include "diagnosis/loop/test_loop.h"
#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "report/diagnosis_page.h"
#include "report/set_comparison.h"
#include "rollrig/diagnose.h"

namespace rollrig {

Loop advance_loop(const LoopInput& input) {
  require_comparable_effects(input.diagnosis.only, input.diagnosis.without);
  require_threads(input.diagnosis.threads);
  const auto step = std::make_shared<const diagnosis::LoopStep>(diagnosis::advance_loop(input));
  Loop loop;
  static_cast<LoopLedger&>(loop) = step->ledger;
  loop.missing = step->missing;
  if (step->diagnosis.has_value()) loop.text = diagnosis::format_summary(*step->diagnosis) + "\n";
  loop.text += diagnosis::format_loop(*step, input.folder);
  Json json = diagnosis::make_ledger_json(step->ledger);
  json["diagnosis"] = nullptr;
  if (step->diagnosis.has_value()) {
    json["diagnosis"] = diagnosis::make_diagnosis_json(*step->diagnosis);
    json["diagnosis"]["phase_means"] = report::list_phase_means(step->set);
  }
  loop.json = to_text(json);
  const DiagnosisOptions options = input.diagnosis;
  loop.make_page = [step, options] {
    const diagnosis::Diagnosis found =
        step->diagnosis.has_value() ? *step->diagnosis : diagnosis::diagnose(step->set, options);
    report::Page page = report::make_diagnosis_page(step->set, found);
    report::add_loop(step->ledger, page);
    return report::make_html(page);
  };
  return loop;
}

}  // namespace rollrig
