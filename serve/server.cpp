#include "serve/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "serve/app_page.h"
#include "serve/error_json.h"
#include "serve/guard.h"
#include "serve/http_server.h"
#include "serve/live_run.h"
#include "serve/set_desk.h"
#include "serve/turnstile.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"

namespace rollrig::serve {
namespace {

// cpp-httplib compresses what it knows as text, "application/json" too, with brotli for browsers: 150 ms for 100 kB. On
// one computer that saves nothing.
constexpr const char* kJson = "application/json; charset=utf-8";
constexpr const char* kHtml = "text/html; charset=utf-8";

int choose_threads(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

ConnectionLimits make_limits(const ServerOptions& options) {
  ConnectionLimits limits;
  limits.head = options.head_limit;
  return limits;
}

RequestHead read_head(const httplib::Request& request) {
  RequestHead head;
  head.method = request.method;
  head.path = request.path;
  // Two Host headers count as none, so that the request is refused.
  head.host = request.get_header_value_count("Host") == 1 ? request.get_header_value("Host") : "";
  if (request.has_header("Origin")) head.origin = request.get_header_value("Origin");
  head.fetch_site = request.get_header_value("Sec-Fetch-Site");
  head.header_token = request.get_header_value(kTokenHeader);
  head.url_token = request.get_param_value("token");
  head.has_range = request.has_header("Range");
  head.is_chunked = request.has_header("Transfer-Encoding");
  if (request.get_header_value_count("Content-Length") == 1) {
    const std::string length = request.get_header_value("Content-Length");
    const bool is_number =
        !length.empty() && length.size() < 16 && length.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) head.content_bytes = std::stoull(length);
  }
  return head;
}

void put_json(const Json& json, httplib::Response& response) {
  // Invalid UTF-8 is replaced, and numbers that are not finite become null, so that the page can read the answer.
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), kJson);
}

/// A page in pieces, which cpp-httplib does not compress.
void put_page(std::string html, httplib::Response& response) {
  const auto page = std::make_shared<const std::string>(std::move(html));
  response.set_content_provider(page->size(), kHtml,
                                [page](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  return sink.write(page->data() + offset, length);
                                });
}

void put_refusal(const Refusal& refusal, httplib::Response& response) {
  response.status = refusal.status();
  put_json({{"error", {{"what", refusal.what()}}}}, response);
}

/// What every answer says to the browser: keep nothing, guess nothing, show it in no frame, tell no other page.
httplib::Headers make_headers() {
  return {{"Cache-Control", "no-store"},
          {"X-Content-Type-Options", "nosniff"},
          {"X-Frame-Options", "DENY"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cross-Origin-Opener-Policy", "same-origin"}};
}

int id_of(const httplib::Request& request) { return std::stoi(request.matches[1].str()); }

}  // namespace

struct Server::Data {
  explicit Data(const ServerOptions& options)
      : token(options.token.empty() ? make_token() : options.token),
        shelf(options.files),
        kept(options.keep_folder),
        desk(shelf, kept, jobs, choose_threads(options.threads)),
        http(make_limits(options)) {}

  std::string token;
  int port = 0;
  Shelf shelf;
  KeptPages kept;
  Jobs jobs;
  SetDesk desk;
  Turnstile runs{2, 8};   // Assumed: the slider that moves, and a page that is kept meanwhile
  Turnstile reads{1, 4};  // Assumed: files are read and a set is simulated
  HttpServer http;
  std::atomic<bool> has_ended{false};
  std::thread thread;

  using Answer = std::function<Json(const httplib::Request&)>;

  /// Answers with JSON, and with the error as JSON.
  void post(const char* path, Answer answer) {
    http.Post(path, [answer = std::move(answer), this](const httplib::Request& request, httplib::Response& response) {
      guard_answer(request, response, [&] { put_json(answer(request), response); });
    });
  }
  void get(const char* path, Answer answer) {
    http.Get(path, [answer = std::move(answer), this](const httplib::Request& request, httplib::Response& response) {
      guard_answer(request, response, [&] { put_json(answer(request), response); });
    });
  }

  template <class Work>
  void guard_answer(const httplib::Request& request, httplib::Response& response, Work&& work) {
    try {
      work();
    } catch (...) {
      const auto error = std::current_exception();
      const bool is_of_set = request.path.rfind("/api/sets/", 0) == 0 && request.matches.size() > 1;
      response.status = find_status(error);
      put_json({{"error", make_error_json(error, is_of_set ? desk.private_part(id_of(request)) : "")}}, response);
    }
  }

  void set_up_guard();
  void route_runs();
  void route_sets();
};

void Server::Data::set_up_guard() {
  http.set_default_headers(make_headers());
  http.set_payload_max_length(kMostFile_bytes);
  http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const auto refusal = find_refusal(read_head(request), token, port);
    if (!refusal.has_value()) return httplib::Server::HandlerResponse::Unhandled;
    put_refusal(*refusal, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  http.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) put_refusal(Refusal(response.status, "there is nothing at this address"), response);
  });
  http.set_post_routing_handler([](const httplib::Request&, httplib::Response& response) {
    const bool is_page = response.get_header_value("Content-Type") == kHtml;  // its own policy stands in it
    response.set_header("Content-Security-Policy",
                        is_page ? "frame-ancestors 'none'" : "default-src 'none'; frame-ancestors 'none'");
  });
}

void Server::Data::route_runs() {
  http.Get("/", [](const httplib::Request&, httplib::Response& response) { put_page(make_app_page(), response); });
  http.Get(R"(/kept/([A-Za-z0-9_.-]{1,120}))", [this](const httplib::Request& request, httplib::Response& response) {
    guard_answer(request, response, [&] { put_page(kept.read(request.matches[1].str()), response); });
  });
  get("/api/choices", [this](const httplib::Request&) {
    Json json = shelf.make_choices();
    json["version"] = ROLLRIG_VERSION;
    json["keep_folder"] = kept.folder();
    json["limits"] = {{"file_bytes", kMostFile_bytes}, {"set_bytes", kMostSet_bytes}, {"files", kMostSetFiles}};
    json["endings"] = taken_endings();
    return json;
  });
  post("/api/run", [this](const httplib::Request& request) {
    const Json asked = parse_json(request.body, "the page");
    const Turnstile::Pass pass(runs);
    return carry_out_live(asked, shelf);
  });
  post("/api/keep", [this](const httplib::Request& request) {
    const Json asked = parse_json(request.body, "the page");
    const Turnstile::Pass pass(runs);
    return Json{
        {"kept", kept.keep(text_of(asked, "scenario") + "-" + text_of(asked, "tire"), make_live_page(asked, shelf))}};
  });
}

void Server::Data::route_sets() {
  post("/api/sets",
       [this](const httplib::Request& request) { return desk.open(parse_json(request.body, "the page")); });
  http.Post(R"(/api/sets/(\d{1,6})/files)", [this](const httplib::Request& request, httplib::Response& response,
                                                   const httplib::ContentReader& read_content) {
    guard_answer(request, response, [&] {
      const std::uint64_t bytes = read_head(request).content_bytes.value_or(0);
      const auto file = desk.take_file(id_of(request), request.get_param_value("name"), bytes);
      const bool is_whole =
          read_content([&file](const char* data, std::size_t size) { return file->append(data, size); });
      if (!is_whole || file->size() != bytes) throw Refusal(400, "the file did not come in whole");
      file->finish();
      put_json({{"bytes", bytes}}, response);
    });
  });
  const auto route = [this](const char* path, Json (SetDesk::*answer)(int, const Json&)) {
    post(path, [this, answer](const httplib::Request& request) {
      const Json asked = parse_json(request.body, "the page");
      const Turnstile::Pass pass(reads);
      return (desk.*answer)(id_of(request), asked);
    });
  };
  route(R"(/api/sets/(\d{1,6})/columns)", &SetDesk::guess);
  route(R"(/api/sets/(\d{1,6})/validate)", &SetDesk::make_set);
  route(R"(/api/sets/(\d{1,6})/diagnose)", &SetDesk::diagnose);
  get("/api/jobs", [this](const httplib::Request&) { return jobs.list(); });
  get(R"(/api/jobs/(\d{1,6}))", [this](const httplib::Request& request) { return jobs.describe(id_of(request)); });
  post(R"(/api/jobs/(\d{1,6})/cancel)", [this](const httplib::Request& request) {
    jobs.cancel(id_of(request));
    return Json::object();
  });
}

Server::Server(const ServerOptions& options) : data_(std::make_unique<Data>(options)) {
  data_->set_up_guard();
  data_->route_runs();
  data_->route_sets();
  data_->port = options.port;
  const bool is_bound = options.port > 0 ? data_->http.bind_to_port(kAddress, options.port)
                                         : (data_->port = data_->http.bind_to_any_port(kAddress)) > 0;
  if (!is_bound) {
    throw InputError({"the port is taken, or not allowed", "command line", 0, "--port", std::to_string(options.port),
                      "a port that is free, from 1024; without --port rollrig finds one", ""});
  }
  data_->http.lengthen_queue();
  data_->thread = std::thread([data = data_.get()] {
    data->http.listen_after_bind();
    data->has_ended = true;
  });
}

Server::~Server() {
  while (!data_->http.is_running() && !data_->has_ended) std::this_thread::yield();  // else stop() would not be heard
  data_->http.end();
  data_->thread.join();
}

int Server::port() const { return data_->port; }
const std::string& Server::token() const { return data_->token; }
const std::string& Server::dropped_folder() const { return data_->desk.folder(); }
std::string Server::url() const { return fmt::format("http://{}:{}/?token={}", kAddress, data_->port, data_->token); }

}  // namespace rollrig::serve
