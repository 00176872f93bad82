// A tire file as TOML.
#include <fmt/format.h>

#include <boost/algorithm/string/trim.hpp>
#include <set>

#include "models/tire/tire_file.h"
#include "models/tire/tire_model.h"
#include "sim/core/units.h"

namespace rollrig::models {
namespace {

/// Builds TOML lines "key = value   # note".
class TomlText {
 public:
  explicit TomlText(const std::map<std::string, std::string>& notes) : notes_(notes) {}

  void header(const std::string& header) {
    text_ += fmt::format("\n{}\n", header);
    table_ = boost::algorithm::trim_copy_if(header, boost::algorithm::is_any_of("[]"));
  }
  void line(const std::string& key, const std::string& value) {
    const std::string assignment = fmt::format("{} = {}", key, value);
    const auto note = notes_.find(table_.empty() ? key : table_ + "." + key);
    text_ += note == notes_.end() ? assignment + "\n" : fmt::format("{:<36} # {}\n", assignment, note->second);
  }
  void number(const std::string& key, double si_value) {
    line(key, fmt::format("{:.10g}", unit_of_key(key).from_si(si_value)));
  }
  template <class Group>
  void group(const std::string& name, const Group& values, const Group* uncertainties = nullptr,
             const std::set<std::string>& absent = {}) {
    header(name);
    std::vector<double> sd;
    if (uncertainties != nullptr)
      Group::visit(*uncertainties, [&sd](const Field&, const double& x) { sd.push_back(x); });
    std::size_t i = 0;
    Group::visit(values, [&](const Field& field, const double& value) {
      if (absent.count(field.key) == 0) number(field.key, value);
      const std::string sd_key = std::string(field.key) + "_sd";
      if (i < sd.size() && sd[i] > 0.0) number(sd_key, sd[i]);
      ++i;
    });
  }
  std::string take() { return std::move(text_); }

 private:
  const std::map<std::string, std::string>& notes_;
  std::string text_;
  std::string table_;
};

void write_service(const ServiceDescription& service, TomlText& out) {
  out.header("[service_description]");
  out.line("class", fmt::format("\"{}\"", name_of(service.tire_class)));
  out.line("load_index", fmt::format("{}", service.load_index));
  if (!service.speed_symbol.empty()) out.line("speed_symbol", "\"" + service.speed_symbol + "\"");
  if (service.is_reinforced) out.line("reinforced", "true");
  if (service.is_severe_snow) out.line("severe_snow", "true");
  if (service.maximum_load_pressure_Pa.has_value()) {
    out.number("maximum_load_pressure_kPa", *service.maximum_load_pressure_Pa);
  }
}

}  // namespace

std::string write_tire(const TireFile& tire, const std::map<std::string, std::string>& notes) {
  TomlText out(notes);
  out.line("format", fmt::format("\"{}/{}\"", kTireFormat, kTireFormatVersion));
  out.line("name", "\"" + tire.name + "\"");
  out.line("designation", "\"" + tire.designation + "\"");
  const std::string& model = tire.values.model().info.id;
  if (&tire.values.model() != &default_tire_model()) out.line("model", "\"" + model + "\"");
  if (tire.basis != TireBasis::kUnknown) {
    out.line("basis", tire.basis == TireBasis::kMeasured ? "\"measured\"" : "\"class\"");
  }
  const TireParameters<double>& sd = tire.standard_uncertainties;
  out.group("[geometry]", tire.values.geometry);
  if (tire.has_stiffness) out.group("[stiffness]", tire.values.stiffness);
  if (tire.has_rolling_resistance && !tire.values.model().info.has_speed_lines) {
    const LossReference<double>& reference = tire.values.rolling_resistance;
    out.group("[rolling_resistance]", reference, static_cast<const LossReference<double>*>(&sd.rolling_resistance));
  } else if (tire.has_rolling_resistance) {
    out.group("[rolling_resistance]", tire.values.rolling_resistance, &sd.rolling_resistance);
    for (std::size_t i = 0; i < tire.values.load_map.size(); ++i) {
      out.group("[[rolling_resistance.load_map]]", tire.values.load_map[i], &sd.load_map[i]);
    }
  }
  if (tire.has_thermal) {
    const TireThermalParameters<double>& thermal = tire.values.thermal;
    const bool cools_by_rig = thermal.rest_conductance_W_per_K == 0.0 && thermal.speed_conductance_W_s_per_m_K == 0.0;
    const std::set<std::string> conductances{"conductance_at_rest_W_per_K", "conductance_per_speed_W_s_per_m_K"};
    out.group("[thermal]", thermal, &sd.thermal, cools_by_rig ? conductances : std::set<std::string>{});
    for (const auto& [rig, at] : tire.rig_thermal) {
      out.header(fmt::format("[thermal.rig.{}]", rig));
      RigThermal::visit(at, [&out](const Field& field, const std::optional<double>& value) {
        if (value.has_value()) out.number(field.key, *value);
      });
    }
  }
  if (!tire.values.own.values.empty()) out.group("[" + model + "]", tire.values.own, &sd.own);
  if (tire.has_constant) out.group("[constant]", tire.values.constant, &sd.constant);
  if (tire.service.has_value()) write_service(*tire.service, out);
  if (tire.iso_28580.has_value()) out.group("[iso_28580]", *tire.iso_28580);
  if (tire.validity.has_value()) out.group("[validity]", *tire.validity);
  if (!tire.sweep_loads_N.empty()) {
    out.header("[load_sweep]");
    out.line("loads_N", fmt::format("[{:.10g}]", fmt::join(tire.sweep_loads_N, ", ")));
  }
  return out.take() + write_correlation(tire.correlation);
}

}  // namespace rollrig::models
