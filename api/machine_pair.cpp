#include "rollrig/machine_pair.h"

#include "api/data.h"
#include "api/effect_options.h"
#include "api/option_range.h"
#include "diagnosis/output/machine_pair_output.h"
#include "diagnosis/pair/machine_pair.h"
#include "diagnosis/terms/machine_terms.h"
#include "report/machine_pair_page.h"

namespace rollrig {

PairDiagnosis diagnose_pair(const MeasurementSet& a, const MeasurementSet& b, const DiagnosisOptions& options) {
  require_apart(options.only, options.without);
  require_threads(options.threads);
  const auto found =
      std::make_shared<const PairFindings>(diagnosis::diagnose_pair(a.data().set, b.data().set, options));
  PairDiagnosis result;
  static_cast<PairFindings&>(result) = *found;
  result.text = diagnosis::format_pair(*found);
  result.json = to_text(diagnosis::make_pair_json(*found));
  result.make_page = [found] { return report::make_html(report::make_machine_pair_page(*found)); };
  return result;
}

std::vector<std::string> list_machine_effects() { return diagnosis::machine_effect_names(); }

}  // namespace rollrig
