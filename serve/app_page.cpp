#include "serve/app_page.h"

#include "sim/core/embed.h"

ROLLRIG_EMBED(rollrig_app_template, "serve/app_template.html")

namespace rollrig::serve {

std::string make_app_page() { return {rollrig_app_template_begin, rollrig_app_template_end}; }

}  // namespace rollrig::serve
