#include "sim/core/text_encoding.h"

#include <catch2/catch.hpp>

#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;

namespace {
std::string as_utf16(const std::string& ascii, bool is_big) {
  std::string bytes = is_big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) bytes += is_big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}
}  // namespace

TEST_CASE("a text of Windows-1252 is read as its characters", "[fast]") {
  const DecodedText decoded = decode_text(
      "T \xB0"
      "C;\x80;\xB5",
      "windows-1252");
  CHECK(decoded.is_valid);
  CHECK(decoded.text == "T \u00B0C;\u20AC;\u00B5");
  const DecodedText wrong = decode_text("a\nb\n\x81", "windows-1252");  // no character has this byte
  CHECK_FALSE(wrong.is_valid);
  CHECK(wrong.valid_lines == 2);
}

TEST_CASE("a byte order mark tells UTF-16, whatever the encoding is said to be", "[fast]") {
  for (const bool is_big : {false, true}) {
    for (const std::string& encoding : encoding_names()) {
      const DecodedText decoded = decode_text(as_utf16("a;b\r\n1;2\r\n", is_big), encoding);
      CHECK(decoded.is_valid);
      CHECK(decoded.text == "a;b\r\n1;2\r\n");
    }
  }
  CHECK_FALSE(decode_text("a,b\n", "utf-16").is_valid);                      // without a mark
  CHECK_FALSE(decode_text(as_utf16("abc", false) + "x", "utf-8").is_valid);  // half a character
}

TEST_CASE("a file that is not of its encoding is refused with the line and the key that says another", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("log.csv"),
                    "a,T in \xB0"
                    "C\n1,2\n");
  CsvForm form;
  form.encoding_hint = "encoding = \"windows-1252\"";
  try {
    CsvTable::read(folder.file("log.csv"), form);
    FAIL("read as UTF-8");
  } catch (const InputError& error) {
    CHECK(error.problem().line == 1);
    CHECK(error.problem().allowed == form.encoding_hint);
  }
  form.encoding = "windows-1252";
  CHECK(CsvTable::read(folder.file("log.csv"), form).columns()[1] == "T in \u00B0C");
  CHECK_THROWS_WITH(read_text_file(folder.file("log.csv")), Catch::Contains("not a text file"));
  tests::write_file(folder.file("zero.csv"), std::string("a\n1\n\0\0\n", 7));
  CHECK_THROWS_WITH(CsvTable::read(folder.file("zero.csv")), Catch::Contains("line 3"));
}
