#include "diagnosis/next_test/test_menu.h"

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

std::vector<PlannedTest> make_test_menu(const PreparedSet& set) { return set.kind().make_test_menu(set); }

}  // namespace rollrig::diagnosis
