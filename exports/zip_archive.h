#pragma once
/// ZIP archives.

#include <map>
#include <string>

namespace rollrig::exports {

/// An archive of files by their paths in it, in this order, compressed. The same files give the same bytes.
std::string make_zip(const std::map<std::string, std::string>& files);

}  // namespace rollrig::exports
