// Debian's Simbody is built without NDEBUG, and its inline functions depend on it.
#ifdef NDEBUG
#error "NDEBUG must not be defined for any target of this project; see cmake/RollrigCompiler.cmake"
#endif
