#pragma once
/// The equations of the program and the numbers that it assumes: docs/physics.md.

#include <string>

namespace rollrig::tools {

/// The whole page as Markdown: doc comments of headers that state an equation, equations and sources of all effects,
/// and every number that is marked as assumed. `root` is the project's folder.
std::string make_physics_page(const std::string& root);

}  // namespace rollrig::tools
