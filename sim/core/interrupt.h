#pragma once
/// Ctrl-C: noticed between steps, so that a run stops cleanly.

namespace rollrig {

/// Makes SIGINT and SIGTERM set a flag; a second one ends the process at once.
void install_interrupt_handler();

/// Throws Interrupted once the flag is set. Cheap enough for every step.
void throw_if_interrupted();

}  // namespace rollrig
