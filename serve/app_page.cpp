#include "serve/app_page.h"

// As in report/page.cpp.
asm(R"(
  .pushsection .rodata
  .globl rollrig_app_template_begin, rollrig_app_template_end
  .hidden rollrig_app_template_begin, rollrig_app_template_end
rollrig_app_template_begin:
  .incbin "serve/app_template.html"
rollrig_app_template_end:
  .popsection
)");

extern "C" {
extern const char rollrig_app_template_begin[];  // NOLINT: a name of the assembler's
extern const char rollrig_app_template_end[];    // NOLINT
}

namespace rollrig::serve {

std::string make_app_page() { return {rollrig_app_template_begin, rollrig_app_template_end}; }

}  // namespace rollrig::serve
