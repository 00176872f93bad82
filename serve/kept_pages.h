#pragma once
/// Pages that are kept: written to a folder, and linked from the page.

#include <map>
#include <mutex>
#include <string>

namespace rollrig::serve {

class KeptPages {
 public:
  /// The folder is made when the first page is kept.
  explicit KeptPages(std::string folder) : folder_(std::move(folder)) {}

  /// Writes a page as "<title>-<date>-<time>.html", of the title letters and digits alone, and never over another file.
  /// Returns the name. Throws InputError where it cannot be written.
  std::string keep(const std::string& title, const std::string& html);
  /// The page of that name. Throws Refusal where this server kept none such.
  std::string read(const std::string& name) const;
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  mutable std::mutex mutex_;
  std::map<std::string, std::string> paths_;  // by name
};

}  // namespace rollrig::serve
