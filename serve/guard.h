#pragma once
/// Which requests are let in: those of the page that this program printed the address of, and no others.

#include <cstdint>
#include <optional>
#include <string>

#include "serve/refusal.h"

namespace rollrig::serve {

constexpr const char* kAddress = "127.0.0.1";  // no other interface
constexpr const char* kTokenHeader = "X-Rollrig-Token";
constexpr std::uint64_t kMostDocument_bytes = std::uint64_t{1} << 20;  // Assumed: of a request in JSON
constexpr std::uint64_t kMostFile_bytes = std::uint64_t{64} << 20;     // Assumed: of a dropped file

/// What the head of a request says.
struct RequestHead {
  std::string method;
  std::string path;
  std::string host;
  std::optional<std::string> origin;
  std::string fetch_site;    // Sec-Fetch-Site; empty where the browser does not say it
  std::string header_token;  // of kTokenHeader
  std::string url_token;     // of ?token=
  bool has_range = false;
  bool is_chunked = false;
  std::optional<std::uint64_t> content_bytes;
};

/// 128 bits of the operating system's random numbers, in hexadecimal. Throws RunFailure where it gives none.
std::string make_token();

/// Whether two texts are equal, in a time that does not depend on where they differ.
bool is_same_secret(const std::string& a, const std::string& b);

/// Why a request is refused; nothing for one that is let in. Its body is not looked at.
/// Host and Origin must name this server: else another page, or a name that resolves to this computer (DNS rebinding),
/// asks. The token of the address is taken for pages alone, that of the header for all.
std::optional<Refusal> find_refusal(const RequestHead& head, const std::string& token, int port);

}  // namespace rollrig::serve
