#pragma once
/// Files of the source that become a part of the program.

/// Declares name_begin and name_end, between which the bytes of a file stand. The assembler takes it in, and finds it
/// from the project's root: a literal of that size would take the compiler long. The path must be a literal, hence a
/// macro. A source that uses it depends on the file (OBJECT_DEPENDS in CMakeLists.txt).
#define ROLLRIG_EMBED(name, path)                                           \
  asm(".pushsection .rodata\n"                                              \
      ".globl " #name "_begin, " #name                                      \
      "_end\n"                                                              \
      ".hidden " #name "_begin, " #name "_end\n" #name                      \
      "_begin:\n"                                                           \
      ".incbin \"" path "\"\n" #name                                        \
      "_end:\n"                                                             \
      ".popsection\n");                                                     \
  extern "C" {                                                              \
  extern const char name##_begin[]; /* NOLINT: a name of the assembler's */ \
  extern const char name##_end[];   /* NOLINT */                            \
  }
