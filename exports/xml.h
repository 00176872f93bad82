#pragma once
/// libxml2 with owners of what it allocates.

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xmlschemas.h>

#include <memory>
#include <string>

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
