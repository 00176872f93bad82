#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace rollrig::fuzz {
namespace {

/// Numbers at and beyond what types and physics hold, and what stands for none.
constexpr std::array<std::string_view, 26> kNumbers{"0",          "-0",       "1",
                                                    "-1",         "1e308",    "-1e308",
                                                    "1e309",      "1e-320",   "1e999",
                                                    "nan",        "inf",      "-inf",
                                                    "2147483648", "-273.16",  "0x10",
                                                    "1_000",      "1,5",      "1e",
                                                    "999999",     "1e-300",   "18446744073709551616",
                                                    "0.1e1",      "4.9e-324", "1.7976931348623157e308",
                                                    "+5",         ""};

/// Characters and words that mean something to some format.
constexpr std::array<std::string_view, 30> kWords{"\"",
                                                  "\"\"\"",
                                                  "'''",
                                                  "\\",
                                                  "\\u0000",
                                                  "[[",
                                                  "]]",
                                                  "{",
                                                  "}",
                                                  "=",
                                                  ".",
                                                  "..",
                                                  "/",
                                                  "\r\n",
                                                  "\t",
                                                  ";",
                                                  "#",
                                                  "true",
                                                  "null",
                                                  "\xEF\xBB\xBF",
                                                  "\xC3",
                                                  "\x1B[2J",
                                                  std::string_view("\0", 1),
                                                  "<script>",
                                                  "%s%n",
                                                  "../../etc/passwd",
                                                  "2024-03-05T13:29:42.464+01:00",
                                                  "25:61:61",
                                                  "\xE2\x80\xAE",
                                                  "format"};

constexpr std::array<std::string_view, 6> kOpened{"[", "{", "(", "[[", "a.", "{\"a\":"};

class Mutation {
 public:
  Mutation(std::string text, const std::string& other, Engine& engine)
      : text_(std::move(text)), other_(other), engine_(engine) {}

  void apply_one() {
    switch (draw(13)) {
      case 0:
        return remove(draw_span(draw(3) == 0 ? 4096 : 16));
      case 1:
        return repeat();
      case 2:
        return replace_number();
      case 3:
        return insert(std::string(pick(kWords)));
      case 4:
        return swap_lines();
      case 5:
        return change_byte();
      case 6:
        return text_.resize(draw(text_.size() + 1));
      case 7:
        return nest();
      case 8:
        return take_from_other();
      case 9:
        return insert(std::string(1, static_cast<char>(draw(256))));
      case 10:
        return remove(line_at(draw_place()));
      case 11:
        return lengthen();
      default:
        return replace_word();
    }
  }
  std::string take() { return std::move(text_); }

 private:
  struct Span {
    std::size_t at = 0;
    std::size_t size = 0;
  };

  std::size_t draw(std::size_t below) { return below == 0 ? 0 : static_cast<std::size_t>(engine_() % below); }
  std::size_t draw_place() { return draw(text_.size() + 1); }
  Span draw_span(std::size_t most) {
    const std::size_t at = draw_place();
    return {at, std::min(draw(most) + 1, text_.size() - at)};
  }
  template <class List>
  std::string_view pick(const List& list) {
    return list[draw(list.size())];
  }
  Span line_at(std::size_t place) const {
    const std::size_t before = place == 0 ? std::string::npos : text_.rfind('\n', place - 1);
    const std::size_t at = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = text_.find('\n', at);
    return {at, (end == std::string::npos ? text_.size() : end + 1) - at};
  }
  /// The characters about a place that belong together.
  template <class Belongs>
  Span token_at(std::size_t place, const Belongs& belongs) const {
    std::size_t at = place;
    std::size_t end = place;
    while (at > 0 && belongs(text_[at - 1])) --at;
    while (end < text_.size() && belongs(text_[end])) ++end;
    return {at, end - at};
  }
  void remove(Span span) { text_.erase(span.at, span.size); }
  void insert(const std::string& what) { text_.insert(draw_place(), what); }
  void put(Span span, std::string_view what) { text_.replace(span.at, span.size, what); }

  void repeat() {
    const Span span = draw(2) == 0 ? line_at(draw_place()) : draw_span(64);
    const std::string part = text_.substr(span.at, span.size);
    const std::size_t times = draw(8) == 0 ? draw(2000) : 1;
    std::string all;
    for (std::size_t i = 0; i < times && all.size() < 65536; ++i) all += part;
    text_.insert(span.at, all);
  }
  void replace_number() {
    const auto is_of_number = [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == 'e';
    };
    const std::size_t place = text_.find_first_of("0123456789", draw_place());
    if (place == std::string::npos) return insert(std::string(pick(kNumbers)));
    put(token_at(place, is_of_number), pick(kNumbers));
  }
  void replace_word() {
    const auto is_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const Span span = token_at(draw_place(), is_of_word);
    const Span from = token_at(draw_place(), is_of_word);
    put(span, text_.substr(from.at, from.size));
  }
  void swap_lines() {
    const Span first = line_at(draw_place());
    const std::string line = text_.substr(first.at, first.size);
    remove(first);
    text_.insert(line_at(draw_place()).at, line);
  }
  void change_byte() {
    if (text_.empty()) return;
    text_[draw(text_.size())] ^= static_cast<char>(1U << draw(8));
  }
  void nest() {
    const std::string_view opened = pick(kOpened);
    const std::size_t depth = draw(4) == 0 ? draw(20000) : draw(200);
    std::string all;
    for (std::size_t i = 0; i < depth; ++i) all += opened;
    insert(all);
  }
  void lengthen() {
    const std::size_t at = draw_place();
    text_.insert(at, draw(4) == 0 ? draw(50000) : draw(300), at < text_.size() ? text_[at] : 'a');
  }
  void take_from_other() {
    if (other_.empty()) return;
    const std::size_t from = draw(other_.size());
    if (draw(2) == 0) return insert(other_.substr(from, draw(200)));
    text_ = text_.substr(0, draw_place()) + other_.substr(from);
  }

  std::string text_;
  const std::string& other_;
  Engine& engine_;
};

}  // namespace

std::string mutate(const std::string& input, const std::string& other, std::size_t most_bytes, Engine& engine) {
  Mutation mutation(input, other, engine);
  for (std::size_t left = 1 + static_cast<std::size_t>(engine() % 8); left > 0; --left) mutation.apply_one();
  std::string changed = mutation.take();
  if (changed.size() > most_bytes) changed.resize(most_bytes);
  return changed;
}

}  // namespace rollrig::fuzz
