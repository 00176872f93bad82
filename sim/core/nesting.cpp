#include "sim/core/nesting.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sim/core/error.h"

namespace rollrig {
namespace {

/// Passes over strings and comments, and counts brackets, points of keys, and commas. JSON is as TOML here: what it
/// does not know (comments, single quotes) its parser refuses at that place.
class NestingScan {
  struct Bracket {
    bool is_brace = false;
    std::size_t fields = 1;
  };

 public:
  NestingScan(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') return skip_to(text_.find('\n', at_));
    if (c == '[' || c == '{') open();
    if ((c == ']' || c == '}') && !open_.empty()) open_.pop_back();
    if (c == ',') count_field();
    count_part(c);
    ++at_;
  }

  void open() {
    open_.push_back({text_[at_] == '{', 1});
    if (open_.size() > kDeepestNesting) {
      throw problem("nested too deeply", fmt::format("at most {} brackets within each other", kDeepestNesting));
    }
  }

  void count_field() {
    if (open_.empty() || !open_.back().is_brace || ++open_.back().fields <= kMostFieldsInBraces) return;
    throw problem("too many keys in one object", fmt::format("at most {}", kMostFieldsInBraces));
  }

  void count_part(char c) {
    constexpr std::string_view kOtherKey = "=,:[]{}\n";
    if (kOtherKey.find(c) != std::string_view::npos) parts_ = 1;
    if (c == '.' && ++parts_ > kMostKeyParts) {
      throw problem("a key with too many parts", fmt::format("at most {} parts with points between", kMostKeyParts));
    }
  }

  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_, 3) == three;
    at_ += is_long ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (is_long ? text_.substr(at_, 3) == three : text_[at_] == quote || text_[at_] == '\n') {
        break;
      }
    }
    if (!is_long) return skip_to(at_ + 1);
    constexpr std::size_t kMostQuotes = 5;  // two of them belong to the string
    at_ = std::min(at_, text_.size());
    const std::string_view end = text_.substr(at_, kMostQuotes);  // not the whole text, which would take squared time
    skip_to(at_ + std::min(end.find_first_not_of(quote), end.size()));
  }

  void skip_to(std::size_t place) { at_ = std::min(place, text_.size()); }

  InputError problem(const std::string& what, const std::string& allowed) const {
    const auto here = text_.begin() + static_cast<std::ptrdiff_t>(at_);
    return InputError({what, path_, static_cast<int>(1 + std::count(text_.begin(), here, '\n')), "", "", allowed, ""});
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
  std::vector<Bracket> open_;
  std::size_t parts_ = 1;  // of the key here
};

}  // namespace

void require_shallow(std::string_view text, const std::string& path) { NestingScan(text, path).run(); }

}  // namespace rollrig
