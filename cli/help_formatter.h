#pragma once
/// Help texts within 80 columns.

#include <CLI/CLI.hpp>

#include <string>

#include "sim/core/text.h"

namespace rollrig::cli {

/// What an option takes, in words: "debug|info" of choices, "INT in [1 - 8]", "positive FLOAT"; empty for a flag.
std::string describe_value(const CLI::Option& option);

/// CLI11's layout, with each description on lines of its own under its name.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return "  " + make_option_name(option, is_positional) + make_option_opts(option) + "\n" +
           wrap(make_option_desc(option), kIndent);
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string type = option->get_type_name();
    const std::size_t at = type.empty() ? std::string::npos : text.find(type);
    return at == std::string::npos ? text : text.replace(at, type.size(), describe_value(*option));
  }
  std::string make_subcommand(const CLI::App* subcommand) const override {
    return "  " + subcommand->get_name() + "\n" + wrap(subcommand->get_description(), kIndent);
  }
  std::string make_description(const CLI::App* app) const override { return wrap(app->get_description(), 0) + "\n"; }

 private:
  static constexpr std::size_t kIndent = 6;
};

}  // namespace rollrig::cli
