#pragma once
/// Ctrl-C: asked for between sets, so that folders half made are taken away.

#include <stdexcept>

namespace blind {

/// The user asked to stop: exit status 130, nothing half-written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// A second signal ends the program as usual.
void install_interrupt_handler();

/// Throws Interrupted where a signal came.
void throw_if_interrupted();

}  // namespace blind
