#include "exports/model_description.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "exports/xml.h"
#include "fmu/log_categories.h"

namespace rollrig::exports {
namespace {

/// An element of a document, for writing.
class Element {
 public:
  explicit Element(xmlNode* node) : node_(node) {}

  Element add(const char* name) const { return Element(xmlNewChild(node_, nullptr, to_xml(name), nullptr)); }
  const Element& set(const char* name, const std::string& value) const {
    xmlNewProp(node_, to_xml(name), to_xml(value));
    return *this;
  }
  const Element& set(const char* name, const char* value) const { return set(name, std::string(value)); }
  const Element& set(const char* name, double value) const { return set(name, fmt::format("{}", value)); }
  const Element& set(const char* name, std::size_t value) const { return set(name, fmt::format("{}", value)); }
  const Element& set(const char* name, int value) const { return set(name, fmt::format("{}", value)); }

 private:
  xmlNode* node_;
};

/// A rate has the unit of its state per second.
std::string name_unit(const fmu::Variable& variable) {
  const std::string& symbol = variable.unit.symbol;
  if (variable.role != fmu::Role::kRate) return symbol;
  return symbol.empty() ? "1/s" : symbol + "/s";
}

void add_units(const Element& root, const std::vector<fmu::Variable>& variables) {
  std::map<std::string, Unit> units;
  for (const fmu::Variable& variable : variables) {
    const std::string name = name_unit(variable);
    if (name.empty()) continue;
    Unit unit = variable.unit;
    if (variable.role == fmu::Role::kRate) unit.dimension = unit.dimension / dimension::kTime;
    units.emplace(name, unit);
  }
  const Element definitions = root.add("UnitDefinitions");
  for (const auto& [name, unit] : units) {
    const Element element = definitions.add("Unit");
    element.set("name", name);
    const Element base = element.add("BaseUnit");
    const std::pair<const char*, int> exponents[]{
        {"kg", unit.dimension.kg}, {"m", unit.dimension.m}, {"s", unit.dimension.s}, {"K", unit.dimension.K}};
    for (const auto& [base_name, exponent] : exponents) {
      if (exponent != 0) base.set(base_name, exponent);
    }
    if (unit.factor != 1.0) base.set("factor", unit.factor);
    if (unit.offset_SI != 0.0) base.set("offset", unit.offset_SI);
    if (name == "K") element.add("DisplayUnit").set("name", "degC").set("offset", -kZeroCelsius_K);
    if (name == "Pa") element.add("DisplayUnit").set("name", "kPa").set("factor", 1e-3);
  }
}

/// What both kinds of the interface can do.
void add_kinds(const Element& root, bool is_fmi3) {
  const char* kSerialize = is_fmi3 ? "canSerializeFMUState" : "canSerializeFMUstate";
  const char* kGetAndSet = is_fmi3 ? "canGetAndSetFMUState" : "canGetAndSetFMUstate";
  const char* kDerivatives = is_fmi3 ? "providesDirectionalDerivatives" : "providesDirectionalDerivative";
  for (const char* kind : {"ModelExchange", "CoSimulation"}) {
    const Element element = root.add(kind);
    element.set("modelIdentifier", kFmuIdentifier).set(kGetAndSet, "true").set(kSerialize, "true");
    element.set(kDerivatives, "true");
    if (kind == std::string("CoSimulation")) {
      element.set("canHandleVariableCommunicationStepSize", "true");
      if (!is_fmi3) element.set("canInterpolateInputs", "true");
    } else {
      element.set(is_fmi3 ? "needsCompletedIntegratorStep" : "completedIntegratorStepNotNeeded",
                  is_fmi3 ? "false" : "true");
    }
  }
}

/// Causality, variability, initial.
void set_role(const Element& element, fmu::Role role) {
  switch (role) {
    case fmu::Role::kInput:
      element.set("causality", "input").set("variability", "continuous");
      return;
    case fmu::Role::kParameter:
      element.set("causality", "parameter").set("variability", "fixed").set("initial", "exact");
      return;
    case fmu::Role::kTime:
      element.set("causality", "independent").set("variability", "continuous");
      return;
    case fmu::Role::kOutput:
    case fmu::Role::kState:
      element.set("causality", "output");
      break;
    case fmu::Role::kRate:
      element.set("causality", "local");
  }
  element.set("variability", "continuous").set("initial", "calculated");
}

bool is_settable(fmu::Role role) { return role == fmu::Role::kInput || role == fmu::Role::kParameter; }
/// Whether it follows from the others at the start.
bool is_calculated(fmu::Role role) { return !is_settable(role) && role != fmu::Role::kTime; }
bool is_output(fmu::Role role) { return role == fmu::Role::kOutput || role == fmu::Role::kState; }

/// `state` is that of a rate: from 1 in version 2, its reference in version 3.
void set_real(const Element& element, const fmu::Variable& variable, std::size_t state) {
  const std::string unit = name_unit(variable);
  if (!unit.empty()) element.set("unit", unit);
  const bool is_temperature = variable.name.find("temperature") != std::string::npos;  // and no difference of two
  if (unit == "K" && is_temperature) element.set("displayUnit", "degC");
  if (unit == "Pa") element.set("displayUnit", "kPa");
  if (std::isfinite(variable.range.lower) && !variable.range.lower_open) element.set("min", variable.range.lower);
  if (std::isfinite(variable.range.upper) && !variable.range.upper_open) element.set("max", variable.range.upper);
  if (variable.role == fmu::Role::kState) element.set("nominal", variable.nominal);
  if (is_settable(variable.role)) element.set("start", variable.start);
  if (variable.role == fmu::Role::kRate) element.set("derivative", state);
}

void add_variables(const Element& root, const std::vector<fmu::Variable>& variables, bool is_fmi3) {
  const Element list = root.add("ModelVariables");
  std::size_t first_state = 0;
  while (variables[first_state].role != fmu::Role::kState) ++first_state;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const fmu::Variable& variable = variables[i];
    const Element element = list.add(is_fmi3 ? "Float64" : "ScalarVariable");
    element.set("name", variable.name).set("valueReference", i).set("description", variable.doc);
    set_role(element, variable.role);
    const std::size_t state = first_state + variable.index;
    set_real(is_fmi3 ? element : element.add("Real"), variable, is_fmi3 ? state : state + 1);
  }
}

void add_structure_fmi2(const Element& root, const std::vector<fmu::Variable>& variables) {
  const Element structure = root.add("ModelStructure");
  const auto add_list = [&](const char* name, bool (*is_in)(fmu::Role)) {
    const Element list = structure.add(name);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (is_in(variables[i].role)) list.add("Unknown").set("index", i + 1);
    }
  };
  add_list("Outputs", &is_output);
  add_list("Derivatives", [](fmu::Role role) { return role == fmu::Role::kRate; });
  add_list("InitialUnknowns", &is_calculated);
}

void add_structure_fmi3(const Element& root, const std::vector<fmu::Variable>& variables) {
  const Element structure = root.add("ModelStructure");
  const auto add_all = [&](const char* name, bool (*is_in)(fmu::Role)) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (is_in(variables[i].role)) structure.add(name).set("valueReference", i);
    }
  };
  add_all("Output", &is_output);
  add_all("ContinuousStateDerivative", [](fmu::Role role) { return role == fmu::Role::kRate; });
  add_all("InitialUnknown", &is_calculated);
}

}  // namespace

std::string make_model_description(const FmuDescription& about, const std::vector<fmu::Variable>& variables) {
  const bool is_fmi3 = about.fmi_version == 3;
  const XmlPointer<xmlDoc> doc(xmlNewDoc(to_xml("1.0")));
  xmlNode* node = xmlNewNode(nullptr, to_xml("fmiModelDescription"));
  xmlDocSetRootElement(doc.get(), node);
  const Element root(node);
  root.set("fmiVersion", is_fmi3 ? "3.0" : "2.0").set("modelName", about.name);
  root.set(is_fmi3 ? "instantiationToken" : "guid", about.token);
  root.set("description", about.description).set("generationTool", about.tool);
  root.set("variableNamingConvention", "flat");
  if (!is_fmi3) root.set("numberOfEventIndicators", 0);
  add_kinds(root, is_fmi3);
  add_units(root, variables);
  const Element categories = root.add("LogCategories");
  for (std::size_t i = 0; i < fmu::count_log_categories(about.fmi_version); ++i) {
    const fmu::LogCategoryInfo& info = fmu::kLogCategories[i];
    categories.add("Category").set("name", info.name).set("description", info.doc);
  }
  root.add("DefaultExperiment").set("startTime", "0").set("stopTime", "1800").set("stepSize", "1");
  add_variables(root, variables, is_fmi3);
  is_fmi3 ? add_structure_fmi3(root, variables) : add_structure_fmi2(root, variables);
  return write_xml(*doc);
}

}  // namespace rollrig::exports
