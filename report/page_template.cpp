#include "report/page_template.h"

// Taken in by the assembler, which finds it from the project's root: as a literal it would take a compiler long.
asm(R"(
  .pushsection .rodata
  .globl rollrig_page_template_begin, rollrig_page_template_end
  .hidden rollrig_page_template_begin, rollrig_page_template_end
rollrig_page_template_begin:
  .incbin "report/page_template.html"
rollrig_page_template_end:
  .popsection
)");

extern "C" {
extern const char rollrig_page_template_begin[];  // NOLINT: a name of the assembler's
extern const char rollrig_page_template_end[];    // NOLINT
}

namespace rollrig::report {

std::string_view page_template() {
  const auto size = static_cast<std::size_t>(rollrig_page_template_end - rollrig_page_template_begin);
  return {rollrig_page_template_begin, size};
}

}  // namespace rollrig::report
