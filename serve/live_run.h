#pragma once
/// A quasi-static run as the page's controls stand: what comes back is what `rollrig run --html` would show.

#include <string>

#include "serve/shelf.h"

namespace rollrig::serve {

/// The member of a request's JSON object. Throws Refusal where it is of another type; text_of() gives "" and
/// object_of() an empty object where there is none.
std::string text_of(const Json& request, const char* key);
const Json& object_of(const Json& request, const char* key);

/// Carries out {scenario, tire, rig, vehicle, settings: {key: number or word}, effects: {id: {key: number}}}. Only
/// numbers and the words that a setting declares are taken, so that no request names a file.
/// The answer: {page, settings, effects, took_ms}: the payload of the page, every setting as used, the effects that
/// act on this machine and tire.
/// Errors  Refusal: a request of another form; InputError, RunFailure: as a run of the command line, and one that takes
///         longer than a minute
/// Checked  tests/serve/live_run_test.cpp
Json carry_out_live(const Json& request, const Shelf& shelf);

/// The same run as a page of its own.
std::string make_live_page(const Json& request, const Shelf& shelf);

}  // namespace rollrig::serve
