#include "serve/page_words.h"

#include <regex>
#include <utility>
#include <vector>

namespace rollrig::serve {
namespace {

/// What stands in place of an option, the longer forms before the shorter.
const std::vector<std::pair<std::regex, std::string>>& list_page_words() {
  static const std::vector<std::pair<std::regex, std::string>> words{
      {std::regex("--tire <name or path>; see rollrig list tires; rollrig new tire makes one"),
       "choose one beside 'Tire', or drop its file with the logs"},
      {std::regex("--rig <name or path>, or --vehicle of a set of the road; see rollrig list rigs; "
                  "rollrig new rig makes one"),
       "choose one beside 'Rig', or drop its file with the logs"},
      {std::regex("--vehicle <name or path>"), "a mapping (import.toml) beside the logs, which names the vehicle"},
      {std::regex("--column \"([^\"=]*)=HEADING\""), "choose the column of '$1' in the table"},
      {std::regex("--column \"([^\"=]*)=([^\"]*)\""), "choose '$2' as the column of '$1' in the table"},
      {std::regex("--value (\\S+)=NUMBER of what was not logged"), "'a constant' where it was not logged"},
      {std::regex("--value (\\S+)=NUMBER"), "'a constant' for '$1' in the table"},
      {std::regex("--unit time=s, ms, min or h"), "a heading with its unit: s, ms, min or h"},
      {std::regex("--unit (\\S+)=UNIT"), "write the unit of '$1' in the table"},
      {std::regex("--cold-pressure NUMBER"), "the field 'Pressure of the cold tire'"},
      {std::regex("--date-order dmy or --date-order mdy"), "dmy or mdy beside 'Order of dates'"},
      {std::regex("--rest (\\S+)=MINUTES"), "minutes in the field 'Rest before $1'"},
      {std::regex("with --skip-bad-rows, bad rows are left out"), "files without bad rows"},
      {std::regex("as --(column|value|unit|date-order|cold-pressure|rest|sensors) says"), "as you have said"},
      {std::regex("--cold-pressure"), "pressure of the cold tire"},
      {std::regex("--date-order"), "order of dates"},
      {std::regex("--only"), "chosen effects"},
      {std::regex("--(column|value|unit|rest|tire|rig|vehicle|sensors)\\b"), "$1"},
  };
  return words;
}

}  // namespace

std::string speak_of_page(const std::string& text) {
  constexpr std::size_t kLongest = 2000;  // std::regex recurses: a longer text holds what a file says, not our words
  if (text.size() > kLongest || text.find("--") == std::string::npos) return text;
  std::string spoken = text;
  for (const auto& [option, words] : list_page_words()) spoken = std::regex_replace(spoken, option, words);
  return spoken;
}

}  // namespace rollrig::serve
