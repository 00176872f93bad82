#pragma once
/// A request that is not answered as it was asked.

#include <stdexcept>
#include <string>

namespace rollrig::serve {

/// What is thrown: the status of HTTP and a sentence for the person at the page.
class Refusal : public std::runtime_error {
 public:
  Refusal(int status, const std::string& what) : std::runtime_error(what), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

}  // namespace rollrig::serve
