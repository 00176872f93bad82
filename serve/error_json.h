#pragma once
/// Errors as the page gets them.

#include <exception>

#include "serve/refusal.h"
#include "sim/core/error.h"
#include "sim/core/json.h"

namespace rollrig::serve {

/// Status of HTTP for an exception: that of a Refusal, 422 for wrong input and for a run that fails, 503 where the
/// program ends or memory does not suffice, 500 for a mistake of the program.
int find_status(const std::exception_ptr& error);

/// {what, file, line, key, value, allowed, nearest}: the parts of an InputProblem that are there. `private_folder`,
/// with its slash, is taken out of them: the person knows the files by their own names.
Json make_error_json(const std::exception_ptr& error, const std::string& private_folder = "");

}  // namespace rollrig::serve
