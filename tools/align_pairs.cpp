/// Aligns pairs of simulated machines that differ by one effect each, and prints how well it works.
///
/// usage: align_pairs <pairs> <seed> own|alike [difference...]
/// `own`: tires of their own loads, 3 to 6 kN; `alike`: tires of one load. docs/alignment.md has the tables.
#include <algorithm>
#include <exception>
#include <iostream>

#include "sim/core/error.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"
#include "tools/machine_pairs.h"

namespace {

using namespace rollrig;

int align_pairs(const std::vector<std::string>& arguments) {
  const auto pairs = arguments.size() < 3 ? std::nullopt : parse_number(arguments[0]);
  const auto seed = arguments.size() < 3 ? std::nullopt : parse_number(arguments[1]);
  if (!pairs.has_value() || !seed.has_value() || *pairs < 1.0 || *pairs > 1e5 || *seed < 0.0 || *seed > 1e15 ||
      (arguments[2] != "own" && arguments[2] != "alike")) {
    std::cerr << "usage: align_pairs <pairs> <seed> own|alike [difference...]\n";
    return 2;
  }
  std::vector<std::string> known;
  for (const tools::MachineDifference& one : tools::list_machine_differences()) known.push_back(one.name);
  std::vector<std::string> wanted(arguments.begin() + 3, arguments.end());
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(unknown_name("difference", name, known));
    }
  }
  if (wanted.empty()) wanted = known;
  const auto loads = arguments[2] == "own" ? tools::TireLoads::kOfItsOwn : tools::TireLoads::kAlike;
  const auto show = [](double done) { std::cerr << '\r' << static_cast<int>(100.0 * done) << " % " << std::flush; };
  const auto all =
      tools::simulate_pairs(wanted, loads, static_cast<std::size_t>(*pairs), static_cast<std::uint64_t>(*seed), show);
  std::cerr << '\r';
  std::cout << tools::make_pair_table(all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    install_interrupt_handler();
    return align_pairs({argv + 1, argv + argc});
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const Interrupted&) {
    return 130;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
