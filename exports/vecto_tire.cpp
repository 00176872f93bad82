#include "exports/vecto_tire.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdarg>
#include <utility>

#include "exports/xml.h"
#include "sim/core/error.h"

namespace rollrig::exports {
namespace {

constexpr const char* kComponentSpace = "urn:tugraz:ivt:VectoAPI:DeclarationComponent:v1.0";
constexpr const char* kDefinitionSpace = "urn:tugraz:ivt:VectoAPI:DeclarationDefinitions:v1.0";

/// The frame of a component file: what is in Data is of the other schema.
constexpr const char* kFrameSchema = R"(<?xml version="1.0"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="qualified"
    targetNamespace="urn:tugraz:ivt:VectoAPI:DeclarationComponent:v1.0">
  <xs:element name="VectoInputDeclaration">
    <xs:complexType>
      <xs:sequence>
        <xs:element name="Tyre">
          <xs:complexType>
            <xs:sequence>
              <xs:any namespace="urn:tugraz:ivt:VectoAPI:DeclarationDefinitions:v1.0" processContents="skip"
                  minOccurs="1" maxOccurs="2"/>
            </xs:sequence>
          </xs:complexType>
        </xs:element>
      </xs:sequence>
      <xs:attribute name="schemaVersion" use="required">
        <xs:simpleType>
          <xs:restriction base="xs:decimal">
            <xs:minExclusive value="0"/>
            <xs:fractionDigits value="1"/>
          </xs:restriction>
        </xs:simpleType>
      </xs:attribute>
    </xs:complexType>
  </xs:element>
</xs:schema>
)";

/// {} stands for the allowed sizes.
constexpr const char* kDataSchema = R"(<?xml version="1.0"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" xmlns:d="urn:tugraz:ivt:VectoAPI:DeclarationDefinitions:v1.0"
    elementFormDefault="qualified" targetNamespace="urn:tugraz:ivt:VectoAPI:DeclarationDefinitions:v1.0">
  <xs:simpleType name="Filled">
    <xs:restriction base="xs:token"><xs:minLength value="1"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="Date">
    <xs:restriction base="xs:dateTime">
      <xs:minInclusive value="2017-01-01T00:00:00Z"/>
      <xs:pattern value=".+T.+Z"/>
    </xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="Version">
    <xs:restriction base="xs:token"><xs:minLength value="5"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="Size">
    <xs:restriction base="xs:string">{}</xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="FourDecimals">
    <xs:restriction base="xs:decimal">
      <xs:pattern value="[-]?([1-9][0-9]*|0)\.[0-9]{{4}}"/>
      <xs:minInclusive value="0.0000"/>
    </xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="Load">
    <xs:restriction base="xs:int"><xs:minInclusive value="0"/></xs:restriction>
  </xs:simpleType>
  <xs:element name="Data">
    <xs:complexType>
      <xs:sequence>
        <xs:element name="Manufacturer" type="d:Filled"/>
        <xs:element name="Model" type="d:Filled"/>
        <xs:element name="CertificationNumber" type="xs:token"/>
        <xs:element name="Date" type="d:Date"/>
        <xs:element name="AppVersion" type="d:Version"/>
        <xs:element name="Dimension" type="d:Size"/>
        <xs:element name="RRCDeclared" type="d:FourDecimals"/>
        <xs:element name="FzISO" type="d:Load"/>
      </xs:sequence>
      <xs:attribute name="id" use="required">
        <xs:simpleType>
          <xs:restriction base="xs:NCName"><xs:minLength value="1"/></xs:restriction>
        </xs:simpleType>
      </xs:attribute>
    </xs:complexType>
  </xs:element>
</xs:schema>
)";

/// What libxml2 says of an error, a line each.
void collect_xml_error(void* list, xmlErrorPtr error) {
  std::string text = error != nullptr && error->message != nullptr ? error->message : "unknown error";
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  static_cast<std::vector<std::string>*>(list)->push_back(std::move(text));
}

XmlPointer<xmlSchema> parse_schema(const std::string& text) {
  const XmlPointer<xmlSchemaParserCtxt> context(xmlSchemaNewMemParserCtxt(text.data(), static_cast<int>(text.size())));
  XmlPointer<xmlSchema> schema(xmlSchemaParse(context.get()));
  if (schema == nullptr) throw std::logic_error("the schema of VECTO's tire is not one");
  return schema;
}

std::string make_data_schema() {
  std::string sizes;
  for (const std::string& size : list_vecto_dimensions()) sizes += fmt::format("<xs:enumeration value=\"{}\"/>", size);
  return fmt::format(kDataSchema, sizes);
}

/// A document without access to the network or to other files.
XmlPointer<xmlDoc> parse_document(const std::string& xml, std::vector<std::string>& problems) {
  xmlSetStructuredErrorFunc(&problems, reinterpret_cast<xmlStructuredErrorFunc>(&collect_xml_error));
  XmlPointer<xmlDoc> doc(xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "tire.xml", nullptr,
                                       XML_PARSE_NONET | XML_PARSE_NOBLANKS));
  xmlSetStructuredErrorFunc(nullptr, nullptr);
  if (doc == nullptr && problems.empty()) problems.emplace_back("not XML");
  return doc;
}

bool is_element(const xmlNode* node, const char* name, const char* space) {
  return node->type == XML_ELEMENT_NODE && xmlStrEqual(node->name, to_xml(name)) != 0 && node->ns != nullptr &&
         xmlStrEqual(node->ns->href, to_xml(space)) != 0;
}

/// VectoInputDeclaration/Tyre/Data, or nullptr.
xmlNode* find_data(const xmlDoc& doc) {
  xmlNode* root = xmlDocGetRootElement(&doc);
  if (root == nullptr) return nullptr;
  for (xmlNode* tire = root->children; tire != nullptr; tire = tire->next) {
    if (!is_element(tire, "Tyre", kComponentSpace)) continue;
    for (xmlNode* data = tire->children; data != nullptr; data = data->next) {
      if (is_element(data, "Data", kDefinitionSpace)) return data;
    }
  }
  return nullptr;
}

void validate(const xmlDoc& doc, std::vector<std::string>& problems) {
  const auto valid_context = [&problems](xmlSchema* schema) {
    XmlPointer<xmlSchemaValidCtxt> context(xmlSchemaNewValidCtxt(schema));
    xmlSchemaSetValidStructuredErrors(context.get(), reinterpret_cast<xmlStructuredErrorFunc>(&collect_xml_error),
                                      &problems);
    return context;
  };
  const XmlPointer<xmlSchema> frame = parse_schema(kFrameSchema);
  const XmlPointer<xmlSchema> content = parse_schema(make_data_schema());
  const int of_frame = xmlSchemaValidateDoc(valid_context(frame.get()).get(), const_cast<xmlDoc*>(&doc));
  xmlNode* data = find_data(doc);
  if (data == nullptr) {
    problems.emplace_back("there is no element Data in Tyre");
    return;
  }
  const int of_data = xmlSchemaValidateOneElement(valid_context(content.get()).get(), data);
  if ((of_frame != 0 || of_data != 0) && problems.empty()) problems.emplace_back("the schema refuses it");
}

std::string read_child(const xmlNode& parent, const char* name) {
  for (const xmlNode* child = parent.children; child != nullptr; child = child->next) {
    if (!is_element(child, name, kDefinitionSpace)) continue;
    xmlChar* content = xmlNodeGetContent(child);
    const std::string text = content != nullptr ? reinterpret_cast<const char*>(content) : "";
    xmlFree(content);
    return text;
  }
  return "";
}

std::string read_id(xmlNode& data) {
  xmlChar* content = xmlGetProp(&data, to_xml("id"));
  const std::string text = content != nullptr ? reinterpret_cast<const char*>(content) : "";
  xmlFree(content);
  return text;
}

void refuse_problems(const std::vector<std::string>& problems, const std::string& path) {
  if (problems.empty()) return;
  throw InputError({fmt::format("VECTO's schema refuses the tire: {}", problems.front()), path, 0, "", "",
                    "a tire component of VECTO, schema 1.0", ""});
}

}  // namespace

const std::vector<std::string>& list_vecto_dimensions() {
  static const std::vector<std::string> sizes{
      "9 R22.5",      "9.00 R20",     "9.5 R17.5",    "10 R17.5",     "10 R22.5",     "10.00 R20",    "11 R22.5",
      "11.00 R20",    "12 R22.5",     "12.00 R20",    "12.00 R24",    "12.5 R20",     "13 R22.5",     "14.00 R20",
      "14.5 R20",     "16.00 R20",    "205/75 R17.5", "215/75 R17.5", "225/70 R17.5", "225/75 R17.5", "235/75 R17.5",
      "245/70 R17.5", "245/70 R19.5", "255/70 R22.5", "265/70 R17.5", "265/70 R19.5", "275/70 R22.5", "275/80 R22.5",
      "285/60 R22.5", "285/70 R19.5", "295/55 R22.5", "295/60 R22.5", "295/80 R22.5", "305/60 R22.5", "305/70 R19.5",
      "305/70 R22.5", "305/75 R24.5", "315/45 R22.5", "315/60 R22.5", "315/70 R22.5", "315/80 R22.5", "325/95 R24",
      "335/80 R20",   "355/50 R22.5", "365/70 R22.5", "365/80 R20",   "365/85 R20",   "375/45 R22.5", "375/50 R22.5",
      "375/90 R22.5", "385/55 R22.5", "385/65 R22.5", "395/85 R20",   "425/65 R22.5", "495/45 R22.5", "525/65 R20.5",
      "11.00 R16",    "6.00 R9",      "205/65 R17.5", "225/75 R16C",  "255/100 R16",  "255/60 R19.5", "265/55 R19.5",
      "275/60 R19.5", "275/80 R20",   "285/65 R16C",  "295/75 R22.5", "325/85 R16",   "435/50 R19.5", "435/50 R22.5",
      "445/40 R22.5", "445/45 R19.5", "445/65 R22.5", "445/75 R22.5", "455/40 R22.5", "455/45 R22.5", "475/80 R20",
      "7.00 R16C",    "7.50 R15",     "7.50 R16",     "7.50 R16C",    "8.25 R15",     "8.25 R16C",    "8.5 R17.5",
      "8 R17.5",      "LT265/75 R16", "385/55 R19.5", "24 R21",       "205/70 R15C",  "215/70 R15C",  "225/70 R15C",
      "185/75 R16C",  "195/65 R16C",  "195/75 R16C",  "205/65 R16C",  "205/75 R16C",  "215/65 R16C",  "215/75 R16C",
      "225/65 R16C",  "235/65 R16C",  "215/60 R17C",  "235/60 R17C"};
  return sizes;
}

std::string make_vecto_xml(const VectoTire& tire) {
  const XmlPointer<xmlDoc> doc(xmlNewDoc(to_xml("1.0")));
  xmlNode* root = xmlNewNode(nullptr, to_xml("VectoInputDeclaration"));
  xmlDocSetRootElement(doc.get(), root);
  xmlNs* component = xmlNewNs(root, to_xml(kComponentSpace), to_xml("tns"));
  xmlNs* definition = xmlNewNs(root, to_xml(kDefinitionSpace), nullptr);
  xmlSetNs(root, component);
  xmlNewProp(root, to_xml("schemaVersion"), to_xml("1.0"));
  xmlNode* component_node = xmlNewChild(root, component, to_xml("Tyre"), nullptr);
  xmlNode* data = xmlNewChild(component_node, definition, to_xml("Data"), nullptr);
  require_xml_text(tire.id, "id", "id");
  xmlNewProp(data, to_xml("id"), to_xml(tire.id));
  const auto add = [data, definition](const char* name, const std::string& text) {
    require_xml_text(text, name, name);
    xmlNewTextChild(data, definition, to_xml(name), to_xml(text));
  };
  add("Manufacturer", tire.manufacturer);
  add("Model", tire.model);
  add("CertificationNumber", tire.certification_number);
  add("Date", tire.date);
  add("AppVersion", tire.app_version);
  add("Dimension", tire.dimension);
  add("RRCDeclared", fmt::format("{:.4f}", tire.rrc));
  add("FzISO", fmt::format("{}", tire.load_N));
  const std::string xml = write_xml(*doc);
  refuse_problems(list_vecto_problems(xml), "");
  return xml;
}

std::vector<std::string> list_vecto_problems(const std::string& xml) {
  std::vector<std::string> problems;
  const XmlPointer<xmlDoc> doc = parse_document(xml, problems);
  if (doc != nullptr) validate(*doc, problems);
  return problems;
}

VectoTire read_vecto_xml(const std::string& xml, const std::string& path) {
  std::vector<std::string> problems;
  const XmlPointer<xmlDoc> doc = parse_document(xml, problems);
  if (doc != nullptr) validate(*doc, problems);
  refuse_problems(problems, path);
  xmlNode& data = *find_data(*doc);
  VectoTire tire;
  tire.id = read_id(data);
  tire.manufacturer = read_child(data, "Manufacturer");
  tire.model = read_child(data, "Model");
  tire.certification_number = read_child(data, "CertificationNumber");
  tire.date = read_child(data, "Date");
  tire.app_version = read_child(data, "AppVersion");
  tire.dimension = read_child(data, "Dimension");
  tire.rrc = std::stod(read_child(data, "RRCDeclared"));
  tire.load_N = std::stoi(read_child(data, "FzISO"));
  return tire;
}

}  // namespace rollrig::exports
