#include "serve/connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "serve/guard.h"

namespace rollrig::serve {

Connection::Connection(socket_t socket, const ConnectionLimits& limits, const std::atomic<bool>& is_ending)
    : socket_(socket), limits_(limits), is_ending_(is_ending), deadline_(start_ + limits.head) {}

Connection::~Connection() {
  if (socket_ >= 0) ::close(socket_);
}

HeadState Connection::receive_head() {
  while (!is_head_done_ && end_ < buffer_.size()) {
    const ssize_t got = ::recv(socket_, buffer_.data() + end_, buffer_.size() - end_, MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    const bool is_nothing_there = got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
    if (is_nothing_there && Clock::now() < deadline_) return HeadState::kSilent;
    if (got <= 0) return HeadState::kGone;
    count_head(end_, static_cast<std::size_t>(got));
    end_ += static_cast<std::size_t>(got);
  }
  return HeadState::kReady;
}

void Connection::begin_answer() {
  start_ = Clock::now();
  deadline_ = start_ + (is_head_done_ ? limits_.request : limits_.head);
}

bool Connection::wait_for(short event) const {
  constexpr std::chrono::milliseconds kBetweenLooks{100};
  while (!is_ending_) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{socket_, event, 0};
    const int found = ::poll(&waiting, 1, static_cast<int>(std::min(left, kBetweenLooks).count()));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
  }
  return false;
}

bool Connection::is_readable() const { return begin_ < end_ || wait_for(POLLIN); }
bool Connection::is_writable() const { return wait_for(POLLOUT); }

bool Connection::count_head(std::size_t first, std::size_t bytes) {
  for (std::size_t i = first; i < first + bytes && !is_head_done_; ++i) {
    ++head_bytes_;
    const char c = buffer_[i];
    if (c == '\n') {
      is_head_done_ = line_bytes_ == 0 && head_bytes_ > 2;
      line_bytes_ = 0;
    } else if (c != '\r') {
      ++line_bytes_;
    }
  }
  if (is_head_done_) deadline_ = start_ + limits_.request;
  return head_bytes_ <= limits_.head_bytes;
}

bool Connection::fill() {
  if (!wait_for(POLLIN)) return false;
  ssize_t got = -1;
  do {
    got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  } while (got < 0 && errno == EINTR);
  if (got <= 0) return false;
  begin_ = 0;
  end_ = static_cast<std::size_t>(got);
  return is_head_done_ || count_head(0, end_);
}

ssize_t Connection::read(char* data, std::size_t size) {
  if (begin_ == end_ && !fill()) return -1;
  const std::size_t count = std::min(size, end_ - begin_);
  std::memcpy(data, buffer_.data() + begin_, count);
  begin_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* data, std::size_t size) {
  if (!is_answering_) deadline_ = Clock::now() + limits_.answer;  // the work for the answer took its time
  is_answering_ = true;
  while (wait_for(POLLOUT)) {
    const ssize_t written = ::send(socket_, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (written >= 0 || (errno != EINTR && errno != EAGAIN)) return written;
  }
  return -1;
}

void Connection::close() {
  ::shutdown(socket_, SHUT_WR);
  deadline_ = Clock::now() + (head_bytes_ > 0 ? limits_.linger : std::chrono::milliseconds(0));
  while (wait_for(POLLIN) && ::recv(socket_, buffer_.data(), buffer_.size(), 0) > 0) {
  }
  ::close(socket_);
  socket_ = -1;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = kAddress;
  port = 0;
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const { get_remote_ip_and_port(ip, port); }

}  // namespace rollrig::serve
