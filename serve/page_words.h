#pragma once
/// Messages of the program that name options of the command line, in the words of the page that serves it.

#include <string>

namespace rollrig::serve {

/// The text with what is done on the page in place of options: "--cold-pressure NUMBER, in kPa, gauge" becomes "the
/// field 'Pressure of the cold tire', in kPa, gauge". Errors, reasons of guesses and warnings go through it.
/// Checked  tests/serve/page_words_test.cpp
std::string speak_of_page(const std::string& text);

}  // namespace rollrig::serve
