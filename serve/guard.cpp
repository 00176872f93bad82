#include "serve/guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>

#include "sim/core/error.h"

namespace rollrig::serve {
namespace {

constexpr std::size_t kLongestPath = 512;  // Assumed: of this server's paths, the names of kept pages are the longest

bool is_own_host(const std::string& host, int port) {
  return host == fmt::format("{}:{}", kAddress, port) || host == fmt::format("localhost:{}", port);
}

bool is_own_origin(const std::string& origin, int port) {
  constexpr const char* kScheme = "http://";
  return origin.rfind(kScheme, 0) == 0 && is_own_host(origin.substr(std::char_traits<char>::length(kScheme)), port);
}

bool is_upload(const std::string& path) {
  constexpr const char* kEnd = "/files";
  const std::size_t length = std::char_traits<char>::length(kEnd);
  return path.size() > length && path.compare(path.size() - length, length, kEnd) == 0;
}

std::optional<Refusal> find_refused_place(const RequestHead& head, int port) {
  if (!is_own_host(head.host, port)) return Refusal(403, "the request names another host than this server");
  if (head.origin.has_value() && !is_own_origin(*head.origin, port)) {
    return Refusal(403, "the request comes from another page");
  }
  if (!head.fetch_site.empty() && head.fetch_site != "same-origin" && head.fetch_site != "none") {
    return Refusal(403, "the request comes from another page");
  }
  return std::nullopt;
}

std::optional<Refusal> find_refused_body(const RequestHead& head) {
  if (head.has_range) return Refusal(400, "parts of a page are not served");
  if (head.method == "GET") {
    if (head.is_chunked || head.content_bytes.value_or(0) > 0) return Refusal(400, "a GET request has no content");
    return std::nullopt;
  }
  if (head.is_chunked || !head.content_bytes.has_value()) {
    return Refusal(411, "the request does not say how long its content is");
  }
  const std::uint64_t most_bytes = is_upload(head.path) ? kMostFile_bytes : kMostDocument_bytes;
  if (*head.content_bytes <= most_bytes) return std::nullopt;
  return Refusal(413, fmt::format("at most {} MiB are taken at once", most_bytes >> 20));
}

}  // namespace

std::string make_token() {
  std::array<unsigned char, 16> bits{};
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size())) {
    throw RunFailure("the operating system gives no random numbers");
  }
  return fmt::format("{:02x}", fmt::join(bits, ""));
}

bool is_same_secret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[std::min(i, b.size() - 1)];
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(other));
  }
  return difference == 0;
}

std::optional<Refusal> find_refusal(const RequestHead& head, const std::string& token, int port) {
  if (auto refusal = find_refused_place(head, port)) return refusal;
  if (head.method != "GET" && head.method != "POST") return Refusal(405, "only GET and POST are answered");
  if (head.path.size() > kLongestPath) return Refusal(414, "the address is too long");
  const bool is_page = head.method == "GET" && head.path.rfind("/api/", 0) != 0;
  const std::string& given = is_page && head.header_token.empty() ? head.url_token : head.header_token;
  if (!is_same_secret(given, token)) {
    return Refusal(403, "the token is wrong: open the address that rollrig serve printed");
  }
  return find_refused_body(head);
}

}  // namespace rollrig::serve
