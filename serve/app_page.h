#pragma once
/// The page of `rollrig serve`, made of report/web (report/CMakeLists.txt).

#include <string>

namespace rollrig::serve {

std::string make_app_page();

}  // namespace rollrig::serve
