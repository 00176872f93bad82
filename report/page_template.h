#pragma once
/// The page without its data: page_template.html, made of report/web (CMakeLists.txt).

#include <string_view>

namespace rollrig::report {

std::string_view page_template();

}  // namespace rollrig::report
