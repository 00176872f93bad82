/// rollrig_blind: measurement sets with a known hidden cause, made by a program that shares nothing with rollrig.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <memory>

#include "validation/generator/bank.h"
#include "validation/generator/ceiling.h"
#include "validation/generator/effect.h"
#include "validation/generator/effect_options.h"
#include "validation/generator/follow_up.h"
#include "validation/generator/interrupt.h"
#include "validation/generator/kind_options.h"
#include "validation/generator/measurement_set.h"
#include "validation/generator/output.h"
#include "validation/generator/problem.h"

namespace blind {
namespace {

constexpr int kMostThreads = 1024;

enum ExitStatus { kDone = 0, kInputError = 2, kRunFailed = 3, kInterrupted = 130 };

struct MakeOptions {
  std::string kind = name_of(Kind::kDrum);
  std::string baseline;
  std::string effects = kNone;
  std::string sizes;
  std::string forms;
  std::string out;
  std::string truth;
  std::string counterfactual;
  SetOrder order;
};

void check_places(const MakeOptions& options) {
  if (!options.truth.empty()) {
    require_writable(options.truth, "--truth");
    if (lies_within(options.truth, options.out)) {
      throw InputError({"the truth may not lie in the set", "--truth", options.truth, "a file outside of --out", ""});
    }
  }
  if (!options.counterfactual.empty() &&
      (lies_within(options.counterfactual, options.out) || lies_within(options.out, options.counterfactual))) {
    throw InputError({"set and counterfactual may not lie in each other", "--counterfactual", options.counterfactual,
                      "a folder beside --out", ""});
  }
}

int make_command(MakeOptions options) {
  options.order.effects = read_effects(options.effects);
  options.order.sizes = read_sizes(options.sizes, options.order.effects);
  options.order.forms = read_forms(options.forms, options.order.effects);
  options.order.kind = read_kind(options.kind);
  check_grounds(options.order.effects, options.order.kind, false);
  if (find_common_grounds(options.order.effects, options.order.kind, false) == kNowhere) {
    throw InputError({"these effects are not found against one law", "--effect", options.effects, "", ""});
  }
  options.order.constant_rrc = read_baseline(options.baseline, options.order.effects, options.order.kind);
  check_places(options);
  StagedFolder set(options.out, "--out");
  std::optional<StagedFolder> without;
  if (!options.counterfactual.empty()) without.emplace(options.counterfactual, "--counterfactual");
  const MadeSet made = make_set(options.order, without.has_value());
  set.write("", made.files);
  if (without.has_value()) without->write("", made.counterfactual);
  if (!options.truth.empty()) write_file(options.truth, made.truth.dump(2) + "\n", "--truth");
  set.commit();
  if (without.has_value()) without->commit();
  return kDone;
}

struct BankOptions {
  std::string effects;
  BankOrder order;
};

/// What a bank is to hold. Throws InputError.
BankOrder read_bank_order(const BankOptions& options) {
  BankOrder order = options.order;
  order.campaigns = read_campaigns(order.kind);
  order.effects = read_effects(options.effects);
  if (options.effects.empty()) order.effects = drawn_effects(order.campaigns, false);
  if (order.kind == kMixed) {
    check_drawn_somewhere(order.effects);
  } else {
    check_grounds(order.effects, order.campaigns.front().kind, true);
  }
  if (order.singles > 0 && order.effects.empty()) {
    throw InputError({"there is no effect for the singles", "--singles", std::to_string(order.singles),
                      "one or more --effects", ""});
  }
  if (order.pairs > 0 && order.effects.size() < 2) {
    throw InputError({"a pair needs two effects", "--pairs", std::to_string(order.pairs), "two or more --effects", ""});
  }
  const std::size_t all = static_cast<std::size_t>(order.each) * order.effects.size() +
                          static_cast<std::size_t>(order.singles + order.none + order.pairs + order.outside);
  if (all == 0) throw InputError({"the bank has no sets", "--each", "0", "one set at least", ""});
  return order;
}

int bank_command(const BankOptions& options) {
  const BankOrder order = read_bank_order(options);
  const auto progress = [](std::size_t done, std::size_t of) {
    if (::isatty(STDERR_FILENO) != 0) std::cerr << fmt::format("\r{} of {} sets{}", done, of, done == of ? "\n" : "");
  };
  const auto sealed = [&order](const std::string& sha256) {
    std::cout << fmt::format("SHA-256 of {}/truth.json: {}\n", order.out, sha256) << std::flush;
    if (!std::cout) throw InputError({"standard output cannot be written to", "", "", "space for it", ""});
  };
  write_bank(order, sealed, progress);
  return kDone;
}

/// Counts on a terminal what takes more than two seconds.
std::function<void(std::size_t, std::size_t)> make_progress() {
  static constexpr auto kQuiet = std::chrono::seconds(2);
  return [start = std::chrono::steady_clock::now()](std::size_t done, std::size_t of) {
    if (::isatty(STDERR_FILENO) == 0 || std::chrono::steady_clock::now() - start < kQuiet) return;
    std::cerr << fmt::format("\r{} of {} sets{}", done, of, done == of ? "\n" : "");
  };
}

int ceiling_command(const CeilingOrder& order) {
  const CeilingWritten written = write_ceiling(order, make_progress());
  std::cout << fmt::format("ceiling of {} sets with effects written to {}\n", written.sets, written.file);
  return kDone;
}

int follow_up_command(const FollowUpOrder& order) {
  const std::size_t sets = write_follow_up(order, make_progress());
  std::cout << fmt::format("{} sets with their next test in {}/sets\n", sets, follow_up_folder(order));
  return kDone;
}

int list_command() {
  for (const EffectKind* kind : effect_kinds()) {
    std::cout << fmt::format("{}{}\n  size     {} [{}]; {:g} does nothing\n", kind->id,
                             kind->outside ? " (outside of the catalog)" : "", kind->meaning, kind->unit,
                             kind->neutral);
    for (const Form& form : kind->forms) std::cout << fmt::format("  form     {}: {}\n", form.name, form.law);
    std::cout << fmt::format("  made on  {}\n  drawn on {}\n", list_kinds(kind->acts), list_kinds(kind->drawn));
  }
  return kDone;
}

/// The option or command nearest to a word of the command line that none is.
std::string find_nearest_option(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* part : app.get_subcommands({})) {
    known.push_back(part->get_name());
    for (const CLI::Option* option : part->get_options()) known.push_back(option->get_name());
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_known = std::find(known.begin(), known.end(), word) != known.end();
    if (!is_known && (i == 1 || word.rfind("--", 0) == 0)) return find_nearest(word, known);
  }
  return {};
}

CLI::App* add_make(CLI::App& app, MakeOptions& options) {
  CLI::App* make = app.add_subcommand("make", "One measurement set");
  make->add_option("--kind", options.kind, "drum, dyno or road [drum]");
  make->add_option("--baseline", options.baseline, "Of a road set: combined or constant_rrc [drawn]");
  make->add_option("--effect", options.effects, "Effect, two as a,b, or none [none]");
  make->add_option("--size", options.sizes, "Its size in its own unit, for two a,b [drawn]");
  make->add_option("--form", options.forms, "Its functional form, for two a,b [drawn]");
  make->add_option("--seed", options.order.seed, "Decides all that is drawn [1]");
  make->add_option("--out", options.out, "Folder of the set, new or empty")->required();
  make->add_option("--truth", options.truth, "File for the truth, outside of the set");
  make->add_option("--counterfactual", options.counterfactual,
                   "Folder for the same set without effect and without noise");
  make->add_option("--runs", options.order.runs, "Number of runs [6]")->check(CLI::Range(1, kMostRuns));
  make->add_flag("--noise-free", options.order.noise_free, "No errors of sensors, no drop-outs");
  make->add_flag("--nominal-base", options.order.nominal_base, "Base parameters as the files have them");
  return make;
}

CLI::App* add_bank(CLI::App& app, BankOptions& options) {
  constexpr int kMostSets = 2000;
  BankOrder& order = options.order;
  CLI::App* bank = app.add_subcommand("bank", "A bank of sets in shuffled order, with one sealed truth");
  bank->add_option("--kind", order.kind, "drum, dyno, road, or mixed: a campaign drawn for each set [drum]");
  bank->add_option("--seed", order.seed, "Decides all that is drawn [1]");
  bank->add_option("--each", order.each, "Sets of each effect [20]")->check(CLI::Range(0, kMostSets));
  bank->add_option("--singles", order.singles, "Sets of one effect, effects and size classes in turn [0]")
      ->check(CLI::Range(0, kMostSets));
  bank->add_option("--none", order.none, "Sets without effect [100]")->check(CLI::Range(0, kMostSets));
  bank->add_option("--pairs", order.pairs, "Sets of two effects [0]")->check(CLI::Range(0, kMostSets));
  bank->add_option("--outside", order.outside, "Sets with an effect outside of the catalog [0]")
      ->check(CLI::Range(0, kMostSets));
  bank->add_option("--effects", options.effects, "Effects, as a,b,c [all of the catalog that the kind shows]");
  bank->add_option("--runs", order.runs, "Number of runs of a set [6]")->check(CLI::Range(1, kMostRuns));
  bank->add_flag("--counterfactual", order.counterfactual, "Also each set without effect and without noise");
  bank->add_option("--out", order.out, "Folder of the bank, new or empty")->required();
  return bank;
}

CLI::App* add_ceiling(CLI::App& app, CeilingOrder& order) {
  CLI::App* ceiling =
      app.add_subcommand("ceiling", "Open the seal of a bank: what an ideal observer makes of its sets");
  ceiling->add_option("bank", order.bank, "Folder made by bank")->required();
  ceiling->add_option("--out", order.out, "File for the ceiling [ceiling.json in the bank]");
  ceiling->add_option("--sets", order.sets, "Numbers of sets, as 0001,0002 [all]")->delimiter(',');
  ceiling->add_flag("--detection", order.detection_alone,
                    "Whether each is to be seen, and not what it can be told from: a tenth of the time");
  ceiling->add_option("--threads", order.threads, "Sets at a time [as many as there are cores]")
      ->check(CLI::Range(1, kMostThreads));
  return ceiling;
}

/// Help within 80 columns: each description on a line of its own.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return fmt::format("  {}{}\n      {}\n", make_option_name(option, is_positional), make_option_opts(option),
                       make_option_desc(option));
  }
};

CLI::App* add_follow_up(CLI::App& app, FollowUpOrder& order) {
  CLI::App* command = app.add_subcommand(
      "followup", "Open the seal of a bank: its sets again, with the tests that rollrig blind plan wrote");
  command->add_option("bank", order.bank, "Folder made by bank")->required();
  command->add_flag("--drawn", order.drawn, "The tests drawn from the menu, not those proposed");
  command->add_option("--threads", order.threads, "Sets at a time [as many as there are cores]")
      ->check(CLI::Range(1, kMostThreads));
  return command;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"rollrig_blind: measurement sets with a known hidden cause, for judging a diagnosis"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  MakeOptions make;
  BankOptions bank;
  CeilingOrder ceiling;
  const CLI::App* make_app = add_make(app, make);
  const CLI::App* bank_app = add_bank(app, bank);
  const CLI::App* ceiling_app = add_ceiling(app, ceiling);
  FollowUpOrder follow_up;
  const CLI::App* follow_up_app = add_follow_up(app, follow_up);
  app.add_subcommand("list", "Effects, their sizes and laws");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    throw InputError({error.what(), "command line", "",
                      "make, bank, ceiling, followup or list; see rollrig_blind <command> --help",
                      find_nearest_option(app, argc, argv)});
  }
  int status = kDone;
  if (make_app->parsed()) {
    status = make_command(make);
  } else if (bank_app->parsed()) {
    status = bank_command(bank);
  } else if (ceiling_app->parsed()) {
    status = ceiling_command(ceiling);
  } else if (follow_up_app->parsed()) {
    status = follow_up_command(follow_up);
  } else {
    status = list_command();
  }
  if (!std::cout.flush()) throw InputError({"standard output cannot be written to", "", "", "space for it", ""});
  return status;
}

int report(const char* what, const std::string& text, int status) {
  std::cout << std::flush;
  std::cerr << what << ": " << text << '\n';
  return status;
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  blind::install_interrupt_handler();
  try {
    return blind::parse_and_run(argc, argv);
  } catch (const blind::InputError& error) {
    return blind::report("error", error.what(), blind::kInputError);
  } catch (const blind::Interrupted&) {
    return blind::report("stopped", "nothing was written", blind::kInterrupted);
  } catch (const std::exception& error) {
    return blind::report("run failed", error.what(), blind::kRunFailed);
  }
}
