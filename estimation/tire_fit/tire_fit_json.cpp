#include <cmath>

#include "estimation/tire_fit/fit_tire.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

Json make_prior_json(const EstimatePrior& prior) {
  return {{"value", prior.value}, {"sd", prior.sd}, {"from", prior.of_class ? "class" : "file"}};
}

Json make_at_speeds_json(const std::vector<AtSpeed>& speeds) {
  Json json = Json::array();
  for (const AtSpeed& speed : speeds) {
    const auto number = [](const Uncertain& at) -> Json { return {{"value", at.value}, {"sd", at.sd}}; };
    json.push_back({{"speed_km_h", unit_of_key("speed_km_h").from_si(speed.at.speed_m_s)},
                    {"load_N", speed.at.load_N},
                    {"pressure_kPa", unit_of_key("pressure_kPa").from_si(speed.at.pressure_Pa)},
                    {"temperature_degC", unit_of_key("temperature_degC").from_si(speed.at.temperature_K)},
                    {"loss_N", number(speed.loss_N)},
                    {"fall_per_degC", number(speed.fall_per_K)},
                    {"conductance_W_per_K", number(speed.conductance_W_per_K)},
                    {"time_constant_s", number(speed.time_constant_s)}});
  }
  return json;
}

Json make_steady_json(const SteadyTire& steady) {
  const auto number = [](const Uncertain& at, double unit) -> Json {
    return {{"value", at.value / unit}, {"sd", at.sd / unit}};
  };
  return {{"speed_km_h", unit_of_key("speed_km_h").from_si(steady.at.speed_m_s)},
          {"ambient_degC", unit_of_key("ambient_degC").from_si(steady.ambient_K)},
          {"load_N", steady.at.load_N},
          {"pressure_kPa", unit_of_key("pressure_kPa").from_si(steady.at.pressure_Pa)},
          {"temperature_degC", unit_of_key("temperature_degC").from_si(steady.at.temperature_K)},
          {"loss_N", number(steady.loss_N, 1.0)},
          {"rrc_N_per_kN", number(steady.rrc, 1e-3)},
          {"fall_percent_per_degC", number(steady.fall_per_K, 1e-2)},
          {"time_constant_min", number(steady.time_constant_s, 60.0)}};
}

}  // namespace

std::vector<ParameterEstimate> list_parameters(const TireFit& fit) {
  std::vector<ParameterEstimate> parameters;
  for (const Estimate& at : fit.estimates) {
    const std::string key = find_file_key(at.key);
    parameters.push_back({key, at.value, at.sd, at.lower_95(), at.upper_95(), unit_of_key(last_part(key)).symbol});
  }
  return parameters;
}

Json make_two_step_json(const TwoStepEstimate& two_step) {
  Json json;
  models::SpeedLines<double>::visit(two_step, [&](const Field& line, double value) { json[line.key] = value; });
  const auto put = [&json](const char* key, double value) {
    json[key] = std::isfinite(value) ? Json(value) : Json(nullptr);  // null where the data do not determine it
  };
  put("z_W_per_K", two_step.rest_conductance_W_per_K);
  put("f_W_s_per_m_K", two_step.speed_conductance_W_s_per_m_K);
  if (two_step.H_gas_W_per_K.has_value()) json["H_gas_W_per_K"] = *two_step.H_gas_W_per_K;
  return json;
}

Json make_fit_json(const measurements::MeasurementSet& set, const TireFit& fit) {
  Json json = {{"format", "rollrig-fit/1"}, {"set", set.name}, {"tire", set.tire.name}, {"rig", set.rig->name}};
  json["parameters"] = Json::array();
  for (const Estimate& estimate : fit.estimates) {
    json["parameters"].push_back({{"name", estimate.key},
                                  {"value", estimate.value},
                                  {"sd", estimate.sd},
                                  {"ci95", {estimate.lower_95(), estimate.upper_95()}},
                                  {"unit", unit_of_key(last_part(estimate.key)).symbol},
                                  {"nuisance", estimate.nuisance}});
    if (estimate.prior.has_value()) json["parameters"].back()["prior"] = make_prior_json(*estimate.prior);
  }
  json["correlation"] = fit.correlation;
  json["at_speeds"] = make_at_speeds_json(fit.at_speeds);
  json["steady"] = make_steady_json(fit.steady);
  json["chi2_per_sample"] = fit.chi2_per_sample;
  json["rest_in_noise"] = std::sqrt(fit.chi2_per_sample);
  json["channels"] = Json::array();
  for (const ChannelFit& channel : fit.channels) {
    json["channels"].push_back(
        {{"channel", channel.channel.header()}, {"samples", channel.samples}, {"whitened_rms", channel.whitened_rms}});
  }
  json["two_step"] = fit.two_step.has_value() ? make_two_step_json(*fit.two_step) : Json(nullptr);
  if (!fit.warnings.empty()) json["warnings"] = fit.warnings;
  return json;
}

}  // namespace rollrig::estimation
