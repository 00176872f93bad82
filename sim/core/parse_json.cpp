#include "sim/core/parse_json.h"

#include <algorithm>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/nesting.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

/// Reads a text only to find the place of its error.
class ErrorPlace : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t place, const std::string& token, const Json::exception&) override {
    place_ = place;
    token_ = token;
    return false;
  }

  std::size_t place() const { return place_; }  // bytes up to the end of the token
  const std::string& token() const { return token_; }

 private:
  std::size_t place_ = 0;
  std::string token_;
};

InputError json_problem(const std::string& text, const std::string& path, bool is_number) {
  ErrorPlace error;
  Json::sax_parse(text, &error);
  const std::size_t before = std::min(error.place() - std::min<std::size_t>(error.place(), 1), text.size());
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(before), '\n');
  if (is_number) {
    return InputError({"a number that is too large", path, static_cast<int>(line), "", shorten(error.token(), 60),
                       "less than 1.8e308", ""});
  }
  return InputError({"not JSON", path, static_cast<int>(line), "", "", "the file as rollrig wrote it", ""});
}

}  // namespace

Json parse_json(const std::string& text, const std::string& path) {
  require_shallow(text, path);
  try {
    return Json::parse(text);
  } catch (const Json::out_of_range&) {
    throw json_problem(text, path, true);
  } catch (const Json::exception&) {
    throw json_problem(text, path, false);
  }
}

Json read_json(const std::string& path) { return parse_json(read_text_file(path), path); }

}  // namespace rollrig
