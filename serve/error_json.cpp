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
  const auto hide_folder = [&](const std::string& text) {
    return private_folder.empty() ? text : boost::algorithm::replace_all_copy(text, private_folder, "");
  };
  Json json{{"what", hide_folder(speak_of_page(problem.what))}};
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = hide_folder(text);
  };
  if (is_place(problem.file)) add("file", problem.file);
  if (problem.line > 0) json["line"] = problem.line;
  add("key", speak_of_page(problem.key));
  if (problem.key == "--rest") {  // what the page asks for
    std::smatch run;
    static const std::regex named("--rest (\\S+)=MINUTES");
    if (std::regex_search(problem.allowed, run, named)) json["rest_before"] = run[1].str();
  }
  add("value", problem.value);  // as it was given: no words of ours
  add("allowed", speak_of_page(problem.allowed));
  add("nearest", speak_of_page(problem.nearest));
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
