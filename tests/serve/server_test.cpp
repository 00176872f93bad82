// The server as clients meet it: what it refuses, that it lives on, that memory stays flat, jobs and their end.
#include <arpa/inet.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#undef si_value
#undef _res

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <thread>

#include "build_paths.h"
#include "serve/guard.h"
#include "serve/server.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

/// A server with a client that has its token.
struct Bench {
  TemporaryFolder folder;
  serve::Server server;

  explicit Bench(std::chrono::milliseconds head_limit = serve::ServerOptions().head_limit)
      : server(make_options(folder, head_limit)) {}

  static serve::ServerOptions make_options(const TemporaryFolder& folder, std::chrono::milliseconds head_limit) {
    serve::ServerOptions options;
    options.keep_folder = folder.file("kept");
    options.head_limit = head_limit;
    return options;
  }
  httplib::Client make_client() const {
    httplib::Client client("127.0.0.1", server.port());
    client.set_default_headers({{serve::kTokenHeader, server.token()}});
    client.set_read_timeout(60);
    return client;
  }
  Json post(const std::string& path, const Json& body, int status = 200) const {
    const auto answer = make_client().Post(path, body.dump(), "application/json");
    REQUIRE(answer);
    INFO(path << ": " << answer->body);
    CHECK(answer->status == status);
    return Json::parse(answer->body);
  }
  Json get(const std::string& path) const {
    const auto answer = make_client().Get(path);
    REQUIRE(answer);
    return Json::parse(answer->body);
  }
  bool is_alive() const { return get("/api/choices").contains("tires"); }
};

const Json kRun{{"scenario", "iso_28580"}, {"tire", "a50"}};

/// The socket of a connection to the server; -1 where there is none.
int open_connection(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return socket;
  ::close(socket);
  return -1;
}

/// Sends bytes as they are and returns what comes back until the server closes.
std::string send_raw(int port, const std::string& bytes) {
  const int socket = open_connection(port);
  if (socket < 0) return "";
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t part = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (part <= 0) break;
    sent += static_cast<std::size_t>(part);
  }
  std::string answer;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0;) {
    answer.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(socket);
  return answer;
}

std::string first_line(const std::string& answer) { return answer.substr(0, answer.find('\r')); }

/// Memory of this process in MiB.
double find_memory_MiB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}

/// Sanitizers keep memory that is freed, so they check only what leaks.
void check_growth([[maybe_unused]] double before_MiB, [[maybe_unused]] double most_MiB) {
#ifndef ROLLRIG_SANITIZED
  CHECK(find_memory_MiB() - before_MiB < most_MiB);
#endif
}

/// A small set with an effect in it, as files.
std::vector<std::pair<std::string, std::string>> make_set(const TemporaryFolder& folder) {
  const ProgramResult made = run_program(
      "run speed_sweep --tire a50 --fidelity quasi_static --sensors source --set 'speeds_km_h=[80,120]' "
      "--set warm_up_min=10 --set settle_min=0 --set effects.bearing_warmup.fall_per_K=0.03 --write-set set --quiet",
      folder.path());
  INFO(made.err);
  REQUIRE(made.status == 0);
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::directory_iterator(folder.file("set"))) {
    files.emplace_back(entry.path().filename().string(), read_file(entry.path().string()));
  }
  return files;
}

int drop(const Bench& bench, const std::vector<std::pair<std::string, std::string>>& files) {
  const int set = bench.post("/api/sets", {{"name", "dropped"}})["set"].get<int>();
  for (const auto& [name, content] : files) {
    const auto answer = bench.make_client().Post(fmt::format("/api/sets/{}/files?name={}", set, name), content,
                                                 "application/octet-stream");
    REQUIRE(answer);
    REQUIRE(answer->status == 200);
  }
  return set;
}

}  // namespace

TEST_CASE("the page and its policy", "[fast]") {
  const Bench bench;
  httplib::Client stranger("127.0.0.1", bench.server.port());
  const auto page = stranger.Get("/?token=" + bench.server.token());
  REQUIRE(page);
  CHECK(page->status == 200);
  CHECK_THAT(page->body, Catch::StartsWith("<!doctype html>"));
  CHECK(page->get_header_value("Cache-Control") == "no-store");
  CHECK(page->get_header_value("X-Content-Type-Options") == "nosniff");
  CHECK(page->get_header_value("Referrer-Policy") == "no-referrer");
  CHECK(page->get_header_value("Content-Security-Policy") == "frame-ancestors 'none'");
  CHECK_THAT(page->body, Catch::Contains("default-src 'none'; connect-src 'self'"));
  CHECK_FALSE(page->has_header("Access-Control-Allow-Origin"));
  CHECK_FALSE(page->has_header("Set-Cookie"));
  CHECK(stranger.Get("/")->status == 403);
  CHECK(stranger.Get("/?token=0")->status == 403);
  CHECK(stranger.Get("/api/choices?token=" + bench.server.token())->status == 403);
  CHECK(stranger.Options("/api/run")->status == 405);
  for (const char* path : {"/favicon.ico", "/api", "/api/", "/api/run/1", "/kept/", "/kept/x.html", "/api/jobs/77",
                           "/api/sets/77/columns"}) {
    INFO(path);
    CHECK(bench.make_client().Get(path)->status == 404);
  }
}

TEST_CASE("requests of other pages and other names are refused", "[fast]") {
  const Bench bench;
  const std::string port = std::to_string(bench.server.port());
  const auto ask = [&](const std::string& head) {
    return first_line(send_raw(bench.server.port(), "GET /api/choices HTTP/1.1\r\n" + head +
                                                        "X-Rollrig-Token: " + bench.server.token() + "\r\n\r\n"));
  };
  CHECK(ask("Host: 127.0.0.1:" + port + "\r\n") == "HTTP/1.1 200 OK");
  CHECK(ask("Host: localhost:" + port + "\r\n") == "HTTP/1.1 200 OK");
  for (const std::string& head :
       {std::string(), "Host: evil.example:" + port + "\r\n", std::string("Host: 127.0.0.1\r\n"),
        "Host: 127.0.0.1:" + port + "\r\nHost: evil.example\r\n",
        "Host: 127.0.0.1:" + port + "\r\nOrigin: http://evil.example\r\n",
        "Host: 127.0.0.1:" + port + "\r\nOrigin: null\r\n",
        "Host: 127.0.0.1:" + port + "\r\nSec-Fetch-Site: cross-site\r\n"}) {
    INFO(head);
    CHECK(ask(head) == "HTTP/1.1 403 Forbidden");
  }
}

TEST_CASE("no path leads to a file", "[fast]") {
  const Bench bench;
  const std::string host = "Host: 127.0.0.1:" + std::to_string(bench.server.port()) +
                           "\r\nX-Rollrig-Token: " + bench.server.token() + "\r\n\r\n";
  for (const char* path : {"/../../../../etc/passwd", "/..%2f..%2f..%2fetc%2fpasswd", "/%2e%2e/%2e%2e/etc/passwd",
                           "//etc/passwd", "/kept/../../../../etc/passwd", "/kept/..%2f..%2fetc%2fpasswd",
                           "/kept/%2fetc%2fpasswd", "/etc/passwd", "/kept/..", "/assets/tires/a50.toml"}) {
    INFO(path);
    const std::string answer = send_raw(bench.server.port(), std::string("GET ") + path + " HTTP/1.1\r\n" + host);
    CHECK_THAT(answer, !Catch::Contains("root:") && !Catch::Contains("rollrig-tire"));
    CHECK_THAT(first_line(answer), Catch::Contains(" 404 ") || Catch::Contains(" 400 "));
  }
  const int set = bench.post("/api/sets", {{"name", "../../x"}})["set"].get<int>();
  for (const char* name :
       {"..%2f..%2fout.csv", "%2ftmp%2fout.csv", "a%2f..%2f..%2f..%2fout.csv", "out%00.csv", "..", ""}) {
    INFO(name);
    const auto answer = bench.make_client().Post(fmt::format("/api/sets/{}/files?name={}", set, name), "1,2\n",
                                                 "application/octet-stream");
    REQUIRE(answer);
    CHECK(answer->status == 400);
  }
}

TEST_CASE("junk is refused, the server lives, memory stays flat", "[slow]") {
  const Bench bench;
  const int port = bench.server.port();
  const std::string head =
      "Host: 127.0.0.1:" + std::to_string(port) + "\r\nX-Rollrig-Token: " + bench.server.token() + "\r\n";
  const std::string junk(10'000'000, 'x');
  const auto throw_junk = [&] {
    CHECK(first_line(send_raw(port, "POST /api/run HTTP/1.1\r\n" + head + "Content-Length: 10000000\r\n\r\n" + junk)) ==
          "HTTP/1.1 413 Payload Too Large");
    CHECK(first_line(send_raw(port, "POST /api/run HTTP/1.1\r\n" + head +
                                        "Transfer-Encoding: chunked\r\n\r\n989680\r\n" + junk + "\r\n0\r\n\r\n")) ==
          "HTTP/1.1 411 Length Required");
    send_raw(port, junk);                                         // one endless line
    send_raw(port, "GET / HTTP/1.1\r\nA: " + junk + "\r\n\r\n");  // one endless header
    std::string many = "GET / HTTP/1.1\r\n";                      // endlessly many
    while (many.size() < 10'000'000) many += "A" + std::to_string(many.size()) + ": b\r\n";
    send_raw(port, many);
    std::string ranges = "GET /api/choices HTTP/1.1\r\n" + head + "Range: bytes=0-";  // as many as fit
    while (ranges.size() < 8000) ranges += ",0-";
    CHECK_THAT(first_line(send_raw(port, ranges + "\r\n\r\n")), Catch::Contains(" 4"));
  };
  bench.post("/api/run", kRun);
  throw_junk();  // what this program itself holds to send it stays with it
  const double before_MiB = find_memory_MiB();
  for (int i = 0; i < 3; ++i) throw_junk();
  const auto nested = bench.make_client().Post("/api/run", std::string(900'000, '['), "application/json");
  REQUIRE(nested);
  CHECK(nested->status == 422);
  CHECK(bench.is_alive());
  check_growth(before_MiB, 20.0);  // of 150 MB that were sent
}

TEST_CASE("no answer is compressed, which takes longer than a run", "[fast]") {
  const Bench bench;
  httplib::Client browser = bench.make_client();
  browser.set_decompress(false);
  const httplib::Headers accepts{{"Accept-Encoding", "gzip, deflate, br"}};
  const auto page = browser.Get("/?token=" + bench.server.token(), accepts);
  REQUIRE(page);
  CHECK(page->status == 200);
  CHECK_FALSE(page->has_header("Content-Encoding"));
  CHECK_THAT(page->body, Catch::StartsWith("<!doctype html>"));
  const auto run = browser.Post("/api/run", accepts, kRun.dump(), "application/json");
  REQUIRE(run);
  CHECK(run->status == 200);
  CHECK_FALSE(run->has_header("Content-Encoding"));
}

TEST_CASE("a hundred clients are answered, one after the other", "[slow]") {
  const Bench bench;
  for (int i = 0; i < 4; ++i) bench.post("/api/run", kRun);
  const auto ask_all = [&bench] {
    std::atomic<int> answered{0};
    std::atomic<int> refused{0};
    std::array<std::atomic<int>, 32> lost{};  // by cpp-httplib's number of the error
    std::vector<std::thread> clients;
    for (int i = 0; i < 100; ++i) {
      clients.emplace_back([&] {
        const auto answer = bench.make_client().Post("/api/run", kRun.dump(), "application/json");
        if (!answer) {
          ++lost[static_cast<std::size_t>(answer.error())];
          return;
        }
        if (answer->status == 200) ++answered;
        if (answer->status == 503) ++refused;
      });
    }
    for (std::thread& client : clients) client.join();
    for (std::size_t i = 0; i < lost.size(); ++i) {
      INFO("error " << i);
      CHECK(lost[i] == 0);
    }
    CHECK(answered + refused == 100);
    CHECK(answered >= 10);
  };
  ask_all();
  const double before_MiB = find_memory_MiB();
  ask_all();
  ask_all();
  check_growth(before_MiB, 30.0);  // the heaps of threads keep what they had; a leak of 200 pages is more
  CHECK(bench.is_alive());
}

TEST_CASE("connections without a request do not keep others out", "[slow]") {
  const Bench bench(std::chrono::minutes(1));
  std::vector<int> sockets;
  for (int i = 0; i < 300; ++i) {  // more than are held at once
    const int socket = open_connection(bench.server.port());
    REQUIRE(socket >= 0);
    if (i % 2 == 0) CHECK(::send(socket, "GET", 3, MSG_NOSIGNAL) == 3);
    sockets.push_back(socket);
  }
  const auto begin = std::chrono::steady_clock::now();
  CHECK(bench.is_alive());
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));  // a minute, would it wait for them
  for (const int socket : sockets) ::close(socket);
}

TEST_CASE("clients that say nothing do not keep others out", "[slow]") {
  const Bench bench(std::chrono::milliseconds(1000));
  std::vector<std::thread> silent;
  for (int i = 0; i < 20; ++i) {  // more than there are threads
    silent.emplace_back([&] { send_raw(bench.server.port(), "GET / HTTP/1.1\r\nA: "); });
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(bench.is_alive());
  for (std::thread& one : silent) one.join();  // the server lets them go
}

TEST_CASE("the server ends at once, though clients say nothing", "[fast]") {
  std::vector<std::thread> silent;
  auto bench = std::make_unique<Bench>(std::chrono::minutes(1));
  for (int i = 0; i < 20; ++i) {  // more than there are threads
    silent.emplace_back([port = bench->server.port()] { send_raw(port, "GET / HTTP/1.1\r\nA: "); });
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto begin = std::chrono::steady_clock::now();
  bench.reset();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));  // a minute, would it wait for them
  for (std::thread& one : silent) one.join();
}

TEST_CASE("a dropped set is validated and diagnosed with progress, and its page kept", "[slow]") {
  const Bench bench;
  const int set = drop(bench, make_set(bench.folder));
  const std::string at = fmt::format("/api/sets/{}/", set);
  CHECK(bench.post(at + "diagnose", Json::object(), 409).contains("error"));  // not validated yet
  CHECK(bench.post(at + "columns", Json::object())["kind"] == "set");
  const Json checked = bench.post(at + "validate", Json::object());
  CHECK_THAT(checked["what"].get<std::string>(), Catch::Contains("2 runs"));
  const Json only{{"bearing_warmup", true}, {"load_exponent", true}};
  const int job = bench.post(at + "diagnose", {{"only", only}})["job"].get<int>();
  Json now;
  double last = 0.0;
  bool has_stage = false;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    now = bench.get(fmt::format("/api/jobs/{}", job));
    last = std::max(last, now["done"].is_number() ? now["done"].get<double>() : 0.0);
    has_stage = has_stage || now["stage"] != "";
  } while (now["state"] == "waiting" || now["state"] == "running");
  INFO(now.dump().substr(0, 500));
  REQUIRE(now["state"] == "done");
  CHECK(last > 0.0);
  CHECK(has_stage);
  const std::string kept = now["result"]["kept"].get<std::string>();
  CHECK(fs::exists(bench.folder.file("kept/" + kept)));
  const auto page = bench.make_client().Get("/kept/" + kept);
  CHECK(page->status == 200);
  CHECK(page->body == read_file(bench.folder.file("kept/" + kept)));
  CHECK(now["result"]["page"]["sections"].size() >= 3);
}

TEST_CASE("a diagnosis is canceled, and the next one runs", "[slow]") {
  const Bench bench;
  const int set = drop(bench, make_set(bench.folder));
  const std::string at = fmt::format("/api/sets/{}/", set);
  bench.post(at + "validate", Json::object());
  const auto wait_for = [&](int job, const std::set<std::string>& states) {
    for (int i = 0; i < 1000; ++i) {
      const std::string state = bench.get(fmt::format("/api/jobs/{}", job))["state"];
      if (states.count(state) != 0) return state;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return std::string("late");
  };
  const int long_one = bench.post(at + "diagnose", Json::object())["job"].get<int>();
  const int waiting = bench.post(at + "diagnose", Json::object())["job"].get<int>();
  CHECK(wait_for(long_one, {"running"}) == "running");
  // A page that is loaded again finds them.
  const Json listed = bench.get("/api/jobs")["jobs"];
  REQUIRE(listed.size() == 2);
  CHECK(listed[0]["job"] == long_one);
  CHECK(listed[0]["state"] == "running");
  CHECK(listed[1]["job"] == waiting);
  CHECK(listed[1]["state"] == "waiting");
  CHECK_FALSE(listed[0]["name"].get<std::string>().empty());
  bench.post(fmt::format("/api/jobs/{}/cancel", waiting), Json::object());
  bench.post(fmt::format("/api/jobs/{}/cancel", long_one), Json::object());
  CHECK(wait_for(waiting, {"canceled"}) == "canceled");
  CHECK(wait_for(long_one, {"canceled", "done"}) == "canceled");
  CHECK_FALSE(fs::exists(bench.folder.file("kept")));
  CHECK(bench.is_alive());
}

TEST_CASE("logs are guessed, and what they do not tell is asked", "[slow]") {
  const Bench bench;
  const fs::path examples = fs::path(ROLLRIG_SOURCE_DIR) / "assets/examples";
  std::vector<std::pair<std::string, std::string>> files;
  for (const char* name : {"own_logs/Warmlauf_40.csv", "hidden_effect/tire.toml", "hidden_effect/rig.toml"}) {
    files.emplace_back(fs::path(name).filename().string(), read_file((examples / name).string()));
  }
  const int set = drop(bench, files);
  const std::string at = fmt::format("/api/sets/{}/", set);
  const Json first = bench.post(at + "columns", Json::object());
  CHECK(first["kind"] == "logs");
  CHECK(first["headings"][2]["name"] == "Geschwindigkeit");
  CHECK(first["problem"]["key"] == "tire");
  CHECK(first["problem"].dump().find("--") == std::string::npos);  // a person on the page has no options
  Json said{{"tire", "tire.toml"}, {"rig", "rig.toml"}};
  const Json second = bench.post(at + "columns", said);
  CHECK_FALSE(second.contains("problem"));
  CHECK(second["columns"].size() >= 5);
  CHECK(second["columns"].dump().find("--") == std::string::npos);
  CHECK(second["guesses"].dump().find("--") == std::string::npos);
  Json no_number = said;
  no_number["cold_pressure_kPa"] = "250";
  bench.post(at + "columns", no_number, 400);
  said["columns"] = {{"load_N", "Nr."}};  // a wrong correction is heard
  const Json third = bench.post(at + "columns", said);
  CHECK(third.dump().find("Nr.") != std::string::npos);
  said.erase("columns");
  const Json checked = bench.post(at + "validate", said);
  CHECK_THAT(checked["what"].get<std::string>(), Catch::Contains("1 run"));
}

TEST_CASE("a wrong file is said without the path of the private folder", "[slow]") {
  const Bench bench;
  const int set = drop(bench, {{"set.toml", "format = \"rollrig-measurements/1\"\nname = 3\n"}, {"a.csv", "1\n"}});
  const Json wrong = bench.post(fmt::format("/api/sets/{}/validate", set), Json::object(), 422);
  CHECK(wrong["error"]["file"] == "set.toml");
  CHECK(wrong.dump().find("rollrig-serve-") == std::string::npos);
}
