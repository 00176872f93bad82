#include "tests/fmu/importer.h"

#include <dlfcn.h>
#include <libxml/parser.h>
#include <libxml/tree.h>
#include <minizip/unzip.h>

#include <catch2/catch.hpp>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "rollrig/fmu.h"

namespace rollrig::tests {
namespace {

std::string read_attribute(xmlNode* node, const char* name) {
  xmlChar* content = xmlGetProp(node, reinterpret_cast<const xmlChar*>(name));
  std::string text = content != nullptr ? reinterpret_cast<const char*>(content) : "";
  xmlFree(content);
  return text;
}

std::string name_of(const xmlNode* node) { return reinterpret_cast<const char*>(node->name); }

xmlNode* find_child(xmlNode* node, const std::string& name) {
  for (xmlNode* child = node->children; child != nullptr; child = child->next) {
    if (child->type == XML_ELEMENT_NODE && name_of(child) == name) return child;
  }
  return nullptr;
}

Described read_variable(xmlNode* node) {
  Described variable;
  variable.reference = static_cast<unsigned>(std::stoul(read_attribute(node, "valueReference")));
  variable.causality = read_attribute(node, "causality");
  xmlNode* real = find_child(node, "Real");  // version 2
  if (real == nullptr) real = node;
  variable.unit = read_attribute(real, "unit");
  const std::string start = read_attribute(real, "start");
  variable.has_start = !start.empty();
  if (variable.has_start) variable.start = std::stod(start);
  const std::string derivative = read_attribute(real, "derivative");
  if (!derivative.empty()) variable.derivative_of = std::stoul(derivative);
  return variable;
}

void log_message(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String category,
                 fmi2String format, ...) {
  char text[2000];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  auto& tire = *static_cast<Fmi2*>(environment);
  tire.messages.emplace_back(text);
  tire.told.push_back({status, category});
}

void log_message_fmi3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  auto& tire = *static_cast<Fmi3*>(environment);
  tire.messages.emplace_back(message);
  tire.told.push_back({status, category});
}

}  // namespace

std::map<std::string, std::string> read_zip(const std::string& bytes) {
  const TemporaryFolder folder;
  write_file(folder.file("archive.zip"), bytes);
  const unzFile archive = unzOpen(folder.file("archive.zip").c_str());
  REQUIRE(archive != nullptr);
  std::map<std::string, std::string> files;
  for (int status = unzGoToFirstFile(archive); status == UNZ_OK; status = unzGoToNextFile(archive)) {
    unz_file_info info;
    char name[256];
    REQUIRE(unzGetCurrentFileInfo(archive, &info, name, sizeof(name), nullptr, 0, nullptr, 0) == UNZ_OK);
    std::string content(info.uncompressed_size, '\0');
    REQUIRE(unzOpenCurrentFile(archive) == UNZ_OK);
    REQUIRE(unzReadCurrentFile(archive, content.data(), static_cast<unsigned>(content.size())) ==
            static_cast<int>(content.size()));
    REQUIRE(unzCloseCurrentFile(archive) == UNZ_OK);  // checks the sum
    files[name] = content;
  }
  unzClose(archive);
  return files;
}

std::vector<unsigned> Description::list(const std::string& causality) const {
  std::vector<unsigned> references;
  for (const auto& [name, variable] : variables) {
    if (variable.causality == causality) references.push_back(variable.reference);
  }
  return references;
}

std::size_t Description::count_states() const {
  std::size_t count = 0;
  for (const auto& [name, variable] : variables) count += variable.derivative_of > 0 ? 1 : 0;
  return count;
}

Description read_description(const std::string& xml) {
  const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> doc(
      xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "modelDescription.xml", nullptr, XML_PARSE_NONET),
      [](xmlDoc* read) { xmlFreeDoc(read); });
  REQUIRE(doc != nullptr);
  xmlNode* root = xmlDocGetRootElement(doc.get());
  Description description;
  description.fmi_version = read_attribute(root, "fmiVersion");
  description.token = read_attribute(root, description.fmi_version == "2.0" ? "guid" : "instantiationToken");
  description.identifier = read_attribute(find_child(root, "CoSimulation"), "modelIdentifier");
  REQUIRE(read_attribute(find_child(root, "ModelExchange"), "modelIdentifier") == description.identifier);
  for (xmlNode* node = find_child(root, "ModelVariables")->children; node != nullptr; node = node->next) {
    if (node->type == XML_ELEMENT_NODE) description.variables[read_attribute(node, "name")] = read_variable(node);
  }
  return description;
}

LoadedFmu::LoadedFmu(const std::string& tire, const std::string& rig, int fmi_version,
                     const std::vector<std::string>& effects) {
  const std::map<std::string, std::string> files = read_zip(make_fmu({tire, rig, effects, fmi_version}));
  description_ = read_description(files.at("modelDescription.xml"));
  const std::string folder = fmi_version == 3 ? "binaries/x86_64-linux/" : "binaries/linux64/";
  library_ = folder_.file(description_.identifier + ".so");
  write_file(library_, files.at(folder + description_.identifier + ".so"));
  handle_ = ::dlopen(library_.c_str(), RTLD_NOW | RTLD_LOCAL);
  INFO((handle_ == nullptr ? ::dlerror() : ""));
  REQUIRE(handle_ != nullptr);
}

LoadedFmu::~LoadedFmu() { ::dlclose(handle_); }

void* LoadedFmu::find_symbol(const char* name) const {
  void* symbol = ::dlsym(handle_, name);
  INFO(name);
  REQUIRE(symbol != nullptr);
  return symbol;
}

Fmi2::Fmi2(const LoadedFmu& from, fmi2Type type, const std::string& name, bool logging_on) : fmu(from) {
  const fmi2CallbackFunctions callbacks{&log_message, nullptr, nullptr, nullptr, this};
  component = FMI2(fmu, fmi2Instantiate)(name.c_str(), type, fmu.description().token.c_str(), "file:///nowhere",
                                         &callbacks, fmi2False, logging_on ? fmi2True : fmi2False);
  REQUIRE(component != nullptr);
}

Fmi2::~Fmi2() { FMI2(fmu, fmi2FreeInstance)(component); }

void Fmi2::set(const std::string& name, double value) {
  const unsigned reference = fmu.description().find(name);
  INFO(name << " = " << value);
  REQUIRE(FMI2(fmu, fmi2SetReal)(component, &reference, 1, &value) == fmi2OK);
}

double Fmi2::get(const std::string& name) {
  const unsigned reference = fmu.description().find(name);
  double value = 0.0;
  INFO(name);
  REQUIRE(FMI2(fmu, fmi2GetReal)(component, &reference, 1, &value) == fmi2OK);
  return value;
}

void Fmi2::set_slope(const std::string& name, double slope_per_s) {
  const unsigned reference = fmu.description().find(name);
  const fmi2Integer order = 1;
  REQUIRE(FMI2(fmu, fmi2SetRealInputDerivatives)(component, &reference, 1, &order, &slope_per_s) == fmi2OK);
}

void Fmi2::initialize(double start_s) {
  REQUIRE(FMI2(fmu, fmi2SetupExperiment)(component, fmi2False, 0.0, start_s, fmi2False, 0.0) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2EnterInitializationMode)(component) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2ExitInitializationMode)(component) == fmi2OK);
}

void Fmi2::step(double time_s, double step_s) {
  REQUIRE(FMI2(fmu, fmi2DoStep)(component, time_s, step_s, fmi2True) == fmi2OK);
}

Fmi3::Fmi3(const LoadedFmu& from, bool is_co_simulation, bool logging_on) : fmu(from) {
  const char* token = fmu.description().token.c_str();
  instance =
      is_co_simulation
          ? FMI3(fmu, fmi3InstantiateCoSimulation)("tire", token, nullptr, false, logging_on, false, false, nullptr, 0,
                                                   this, &log_message_fmi3, nullptr)
          : FMI3(fmu, fmi3InstantiateModelExchange)("tire", token, nullptr, false, logging_on, this, &log_message_fmi3);
  REQUIRE(instance != nullptr);
}

Fmi3::~Fmi3() { FMI3(fmu, fmi3FreeInstance)(instance); }

void Fmi3::set(const std::string& name, double value) {
  const unsigned reference = fmu.description().find(name);
  REQUIRE(FMI3(fmu, fmi3SetFloat64)(instance, &reference, 1, &value, 1) == fmi3OK);
}

double Fmi3::get(const std::string& name) {
  const unsigned reference = fmu.description().find(name);
  double value = 0.0;
  REQUIRE(FMI3(fmu, fmi3GetFloat64)(instance, &reference, 1, &value, 1) == fmi3OK);
  return value;
}

void Fmi3::initialize() {
  REQUIRE(FMI3(fmu, fmi3EnterInitializationMode)(instance, false, 0.0, 0.0, false, 0.0) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3ExitInitializationMode)(instance) == fmi3OK);
}

fmi3Status Fmi3::step(double time_s, double step_s) {
  bool flags[3] = {true, true, true};
  double last_s = -1.0;
  const fmi3Status status =
      FMI3(fmu, fmi3DoStep)(instance, time_s, step_s, true, &flags[0], &flags[1], &flags[2], &last_s);
  if (status == fmi3OK) {
    CHECK_FALSE((flags[0] || flags[1] || flags[2]));
    CHECK(last_s == Approx(time_s + step_s));
  }
  return status;
}

}  // namespace rollrig::tests
