#pragma once
/// libxml2 with owners of what it allocates.

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xmlschemas.h>

#include <memory>
#include <string>

#include "sim/core/error.h"

namespace rollrig::exports {

struct XmlFree {
  void operator()(xmlDoc* doc) const { xmlFreeDoc(doc); }
  void operator()(xmlSchema* schema) const { xmlSchemaFree(schema); }
  void operator()(xmlSchemaParserCtxt* context) const { xmlSchemaFreeParserCtxt(context); }
  void operator()(xmlSchemaValidCtxt* context) const { xmlSchemaFreeValidCtxt(context); }
};
template <class T>
using XmlPointer = std::unique_ptr<T, XmlFree>;

inline const xmlChar* to_xml(const std::string& text) { return reinterpret_cast<const xmlChar*>(text.c_str()); }
inline const xmlChar* to_xml(const char* text) { return reinterpret_cast<const xmlChar*>(text); }

/// Refuses what XML cannot hold, by an InputError that calls it `what`, with the `key` and its file.
inline void require_xml_text(const std::string& text, const std::string& what, const std::string& key,
                             const std::string& file = "") {
  bool is_good = xmlCheckUTF8(to_xml(text)) != 0;
  for (const char c : text) is_good = is_good && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  for (const char* no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {  // U+FFFE, U+FFFF
    is_good = is_good && text.find(no_character) == std::string::npos;
  }
  if (is_good) return;
  throw InputError(
      {what + " has characters that are not text", file, 0, key, "", "text in UTF-8 without control characters", ""});
}

/// The document as indented text in UTF-8.
inline std::string write_xml(xmlDoc& doc) {
  xmlChar* bytes = nullptr;
  int size = 0;
  xmlDocDumpFormatMemoryEnc(&doc, &bytes, &size, "UTF-8", 1);
  std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  xmlFree(bytes);
  return text;
}

}  // namespace rollrig::exports
