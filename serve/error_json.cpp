#include "serve/error_json.h"

#include <boost/algorithm/string/replace.hpp>

#include <new>
#include <regex>

#include "serve/page_words.h"

namespace rollrig::serve {
namespace {

/// Whether an error names a file, and not an option or the page itself.
bool is_place(const std::string& file) {
  return !file.empty() && file != "command line" && file != "--set" && file != "the page";
}

Json make_problem_json(const InputProblem& problem, const std::string& private_folder) {
  const auto open = [&](const std::string& text) {
    const std::string spoken = speak_of_page(text);
    return private_folder.empty() ? spoken : boost::algorithm::replace_all_copy(spoken, private_folder, "");
  };
  Json json{{"what", open(problem.what)}};
  if (is_place(problem.file)) json["file"] = open(problem.file);
  if (problem.line > 0) json["line"] = problem.line;
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = open(text);
  };
  add("key", problem.key);
  if (problem.key == "--rest") {  // what the page asks for
    std::smatch run;
    static const std::regex named("--rest (\\S+)=MINUTES");
    if (std::regex_search(problem.allowed, run, named)) json["rest_before"] = run[1].str();
  }
  add("value", problem.value);
  add("allowed", problem.allowed);
  add("nearest", problem.nearest);
  return json;
}

}  // namespace

int find_status(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Refusal& refusal) {
    return refusal.status();
  } catch (const InputError&) {
    return 422;
  } catch (const RunFailure&) {
    return 422;
  } catch (const Interrupted&) {
    return 503;
  } catch (const std::bad_alloc&) {
    return 503;
  } catch (...) {
    return 500;
  }
}

Json make_error_json(const std::exception_ptr& error, const std::string& private_folder) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& wrong) {
    return make_problem_json(wrong.problem(), private_folder);
  } catch (const Interrupted&) {
    return {{"what", "stopped"}};
  } catch (const std::bad_alloc&) {
    return {{"what", "the memory of this computer does not suffice"}};
  } catch (const std::exception& other) {
    return make_problem_json({other.what(), "", 0, "", "", "", ""}, private_folder);
  } catch (...) {
    return {{"what", "a mistake in rollrig"}};
  }
}

}  // namespace rollrig::serve
