// Which requests are let in.
#include <catch2/catch.hpp>

#include <set>

#include "serve/guard.h"

using namespace rollrig;
using serve::find_refusal;
using serve::RequestHead;

namespace {

constexpr int kPort = 8765;
const std::string kToken = "0123456789abcdef0123456789abcdef";

/// The page's own request of a run.
RequestHead make_good_head() {
  RequestHead head;
  head.method = "POST";
  head.path = "/api/run";
  head.host = "127.0.0.1:8765";
  head.origin = "http://127.0.0.1:8765";
  head.fetch_site = "same-origin";
  head.header_token = kToken;
  head.content_bytes = 100;
  return head;
}

/// Status of the answer; 0 where it is let in.
int status_of(const RequestHead& head) {
  const auto refusal = find_refusal(head, kToken, kPort);
  return refusal.has_value() ? refusal->status() : 0;
}

template <class Change>
int status_with(Change&& change) {
  RequestHead head = make_good_head();
  change(head);
  return status_of(head);
}

}  // namespace

TEST_CASE("the page's own requests are let in", "[fast]") {
  CHECK(status_of(make_good_head()) == 0);
  CHECK(status_with([](auto& head) { head.host = "localhost:8765", head.origin = "http://localhost:8765"; }) == 0);
  CHECK(status_with([](auto& head) { head.origin.reset(), head.fetch_site = ""; }) == 0);  // a program's
  RequestHead page;
  page.method = "GET";
  page.path = "/";
  page.host = "127.0.0.1:8765";
  page.fetch_site = "none";  // typed into the browser
  page.url_token = kToken;
  CHECK(status_of(page) == 0);
}

TEST_CASE("another host, origin or site is refused", "[fast]") {
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:87650", "evil.example:8765", "evil.example",
                           "127.0.0.1.evil.example:8765", "[::1]:8765", "127.0.0.1:8765@evil.example"}) {
    INFO(host);
    CHECK(status_with([host](auto& head) { head.host = host; }) == 403);
  }
  for (const char* origin :
       {"", "null", "http://evil.example", "https://127.0.0.1:8765", "http://127.0.0.1", "http://127.0.0.1:8766",
        "http://evil.example:8765", "http://127.0.0.1:8765.evil.example", "file://", "http://127.0.0.1:8765/"}) {
    INFO(origin);
    CHECK(status_with([origin](auto& head) { head.origin = origin; }) == 403);
  }
  for (const char* site : {"cross-site", "same-site", "other"}) {
    CHECK(status_with([site](auto& head) { head.fetch_site = site; }) == 403);
  }
}

TEST_CASE("a wrong token is refused, and that of the address does nothing but open pages", "[fast]") {
  std::string almost = kToken;
  almost.back() = '0';
  for (const std::string& token : {std::string(), almost, kToken + "0", kToken.substr(1), std::string(32, '\0')}) {
    CHECK(status_with([&](auto& head) { head.header_token = token; }) == 403);
  }
  CHECK(status_with([](auto& head) { head.header_token = "", head.url_token = kToken; }) == 403);
  CHECK(status_with([](auto& head) {
          head.method = "GET", head.path = "/api/choices", head.content_bytes.reset();
          head.header_token = "", head.url_token = kToken;
        }) == 403);
}

TEST_CASE("other methods, content without a length and too much of it are refused", "[fast]") {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "PATCH", "TRACE", "get"}) {
    CHECK(status_with([method](auto& head) { head.method = method; }) == 405);
  }
  CHECK(status_with([](auto& head) { head.content_bytes.reset(); }) == 411);
  CHECK(status_with([](auto& head) { head.is_chunked = true; }) == 411);
  CHECK(status_with([](auto& head) { head.content_bytes = serve::kMostDocument_bytes; }) == 0);
  CHECK(status_with([](auto& head) { head.content_bytes = serve::kMostDocument_bytes + 1; }) == 413);
  CHECK(status_with([](auto& head) {
          head.path = "/api/sets/1/files", head.content_bytes = serve::kMostDocument_bytes + 1;
        }) == 0);
  CHECK(status_with([](auto& head) {
          head.path = "/api/sets/1/files", head.content_bytes = serve::kMostFile_bytes + 1;
        }) == 413);
  CHECK(status_with([](auto& head) { head.path = "/" + std::string(600, 'a'); }) == 414);
  CHECK(status_with([](auto& head) { head.has_range = true; }) == 400);
}

TEST_CASE("tokens are 128 bits and never the same", "[fast]") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(serve::make_token());
  CHECK(tokens.size() == 100);
  for (const std::string& token : tokens) {
    CHECK(token.size() == 32);
    CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
  }
}
