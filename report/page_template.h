#pragma once
/// The page without its data, made from report/web at build time.

#include <string_view>

namespace rollrig::report {

std::string_view page_template();

}  // namespace rollrig::report
