#include "rollrig/label.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cmath>

#include "api/declared_rrc.h"
#include "models/tire/label_class.h"
#include "models/tire/tire_file.h"
#include "scenarios/scaffold/iso_test.h"
#include "scenarios/scaffold/tire_size.h"
#include "sim/core/assets.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/json.h"

namespace rollrig {
namespace {

constexpr double kRatioPer_N_per_kN = 1e-3;  // N/N in one N/kN

models::TireClass read_label_class(const std::string& name) {
  if (const auto found = models::find_class_named(boost::algorithm::to_upper_copy(name))) return *found;
  InputProblem problem = unknown_name("class", name, models::list_tire_classes());
  problem.file = "command line";
  problem.key = "--class";
  throw InputError(problem);
}

/// Throws InputError where a mark that is given is not that of the tire's file.
void require_own_mark(const models::TireFile& tire, const char* option, const std::string& mark, const std::string& own,
                      const std::string& given) {
  if (own == given) return;
  throw InputError({fmt::format("tire '{}' has {} {} by its file, not {}", tire.name, mark, own, given), "command line",
                    0, option, given, fmt::format("{}, or no {}", own, option), ""});
}

/// The tire's own marks, and those that are given where its file has none.
models::ServiceDescription merge_service(const LabelInput& input, const std::optional<models::TireFile>& tire) {
  models::ServiceDescription service;
  if (tire.has_value() && tire->service.has_value()) service = *tire->service;
  scenarios::ParsedServiceDescription parsed;
  if (!input.load_index.empty()) {
    parsed = scenarios::parse_service_description(input.load_index);
    service.load_index = parsed.load_index;
  }
  const std::string given = scenarios::choose_speed_symbol(input.speed_symbol, parsed);
  if (!given.empty()) service.speed_symbol = given;
  if (tire.has_value() && tire->service.has_value()) {
    const models::ServiceDescription& own = *tire->service;
    require_own_mark(*tire, "--load-index", "load index", fmt::format("{}", own.load_index),
                     fmt::format("{}", service.load_index));
    const std::string symbol = own.speed_symbol.empty() ? service.speed_symbol : own.speed_symbol;
    require_own_mark(*tire, "--speed-symbol", "speed symbol", symbol, service.speed_symbol);
  }
  service.is_severe_snow = service.is_severe_snow || input.is_severe_snow;
  return service;
}

/// The class that is given, else that of the tire's file, else C3 by a load index that no other class has.
models::TireClass choose_class(const LabelInput& input, const std::optional<models::TireFile>& tire, int load_index) {
  const bool file_says = tire.has_value() && tire->service.has_value();
  if (!input.tire_class.empty()) {
    const models::TireClass given = read_label_class(input.tire_class);
    if (!file_says || given == tire->service->tire_class) return given;
    throw InputError(
        {fmt::format("tire '{}' is of class {} by its file", tire->name, name_of(tire->service->tire_class)),
         "command line", 0, "--class", input.tire_class,
         fmt::format("{}, or no --class", name_of(tire->service->tire_class)), ""});
  }
  if (file_says) return tire->service->tire_class;
  if (load_index > models::kHighestLightIndex) return models::TireClass::kC3;
  const std::string who = tire.has_value() ? fmt::format("tire '{}' has no [service_description]", tire->name)
                                           : "the class of the tire is not given";
  throw InputError({who + ", which the bounds of the label depend on", "command line", 0, "--class", "",
                    "--class C1 (passenger cars), C2 (vans) or C3 (trucks)", ""});
}

/// Throws InputError where class, load index and speed symbol contradict each other, as far as they are known.
void require_class_fits(const models::ServiceDescription& service) {
  const bool is_part_unknown = service.load_index == 0 || service.speed_symbol.empty();
  if (service.tire_class == models::TireClass::kC3 && is_part_unknown) return;
  if (const auto mistake = models::find_class_mistake(service)) {
    throw InputError({mistake->what, "command line", 0, "--class", name_of(service.tire_class), mistake->allowed, ""});
  }
}

models::ServiceDescription find_label_service(const LabelInput& input, const std::optional<models::TireFile>& tire) {
  models::ServiceDescription service = merge_service(input, tire);
  service.tire_class = choose_class(input, tire, service.load_index);
  if (service.tire_class != models::TireClass::kC1) service.is_reinforced = false;
  require_class_fits(service);
  return service;
}

/// The tire with the marks that its label goes by. A file without [service_description] does not say whether the tire
/// is reinforced: its pressure does.
models::TireFile with_service(models::TireFile tire, models::ServiceDescription service) {
  const bool is_car = service.tire_class == models::TireClass::kC1;
  if (!tire.service.has_value() && is_car && tire.iso_28580.has_value()) {
    constexpr double kBetweenBoth_Pa = 230e3;  // 210 kPa, reinforced 250 kPa
    service.is_reinforced = tire.iso_28580->pressure_Pa > kBetweenBoth_Pa;
  }
  tire.service = service;
  return tire;
}

/// The RRc that is given, else that of the simulated test, whose warnings are added.
double find_label_rrc(const LabelInput& input, const std::optional<models::TireFile>& tire,
                      const models::ServiceDescription& service, std::vector<std::string>& warnings) {
  if (input.rrc_N_per_kN.has_value()) {
    if (tire.has_value()) warnings = tire->list_class_doubts();
    const double rrc = read_declared_rrc(*input.rrc_N_per_kN);
    if (const auto doubt = models::doubt_class_by_rrc(service.tire_class, rrc, service.is_severe_snow)) {
      warnings.push_back(*doubt);
    }
    return rrc;
  }
  if (tire.has_value()) {
    const scenarios::StatedIsoTest test = scenarios::simulate_stated_iso_test(with_service(*tire, service));
    warnings = test.warnings;
    return test.rrc;
  }
  throw InputError({"neither an RRc nor a tire is given", "command line", 0, "--rrc", "",
                    "--rrc NUMBER in N/kN, or --tire NAME", ""});
}

double find_label_rrc_sd(const LabelInput& input, models::TireClass tire_class) {
  constexpr double kHighest_N_per_kN = 5.0;
  if (!input.rrc_sd_N_per_kN.has_value()) return models::get_highest_laboratory_sd(tire_class);
  const double sd_N_per_kN = *input.rrc_sd_N_per_kN;
  if (sd_N_per_kN >= 0.0 && sd_N_per_kN <= kHighest_N_per_kN) return sd_N_per_kN * kRatioPer_N_per_kN;
  throw InputError({"--rrc-sd is out of range", "command line", 0, "--rrc-sd", fmt::format("{:g}", sd_N_per_kN),
                    fmt::format("0 to {:g} N/kN", kHighest_N_per_kN), ""});
}

/// Probability that the declared RRc is not above a limit.
double calc_met_probability(double limit, double rrc, double rrc_sd) {
  constexpr double kHalfStep = 5e-5;
  if (rrc_sd <= 0.0) return models::round_declared_rrc(rrc) <= limit + kHalfStep ? 1.0 : 0.0;
  return 0.5 * std::erfc((rrc - limit - kHalfStep) / (rrc_sd * std::sqrt(2.0)));
}

void fill_label(const models::ServiceDescription& service, double rrc, double rrc_sd, TireLabel& label) {
  const models::TireClass tire_class = service.tire_class;
  label.tire_class = name_of(tire_class);
  label.rrc_N_per_kN = rrc / kRatioPer_N_per_kN;
  label.declared_rrc_N_per_kN = std::round(1e4 * models::round_declared_rrc(rrc)) / 10.0;
  label.rrc_sd_N_per_kN = rrc_sd / kRatioPer_N_per_kN;
  label.label_class = models::kLabelClasses[models::find_label_class(tire_class, rrc)];
  const auto probabilities = models::calc_label_probabilities(tire_class, rrc, rrc_sd);
  const auto bounds = models::list_label_bounds(tire_class);
  for (std::size_t i = 0; i < models::kLabelClassCount; ++i) {
    label.classes.push_back({models::kLabelClasses[i], {}, probabilities[i]});
    if (i < bounds.size()) label.classes.back().upper_N_per_kN = bounds[i] / kRatioPer_N_per_kN;
  }
  for (const models::RrcLimit& limit : models::list_rrc_limits(tire_class, service.is_severe_snow)) {
    label.limits.push_back({limit.stage, limit.rrc / kRatioPer_N_per_kN,
                            calc_met_probability(limit.rrc, rrc, 0.0) > 0.5,
                            calc_met_probability(limit.rrc, rrc, rrc_sd)});
  }
}

Json make_label_json(const TireLabel& label) {
  Json json = {{"format", "rollrig-label/1"},
               {"tire_class", label.tire_class},
               {"label_class", label.label_class},
               {"rrc_N_per_kN", label.rrc_N_per_kN},
               {"declared_rrc_N_per_kN", label.declared_rrc_N_per_kN},
               {"rrc_sd_N_per_kN", label.rrc_sd_N_per_kN},
               {"classes", Json::array()},
               {"limits", Json::array()}};
  for (const LabelClassShare& one : label.classes) {
    json["classes"].push_back({{"name", one.name},
                               {"upper_N_per_kN", one.upper_N_per_kN.has_value() ? Json(*one.upper_N_per_kN) : Json()},
                               {"probability", one.probability}});
  }
  for (const ApprovalLimit& limit : label.limits) {
    json["limits"].push_back({{"stage", limit.stage},
                              {"upper_N_per_kN", limit.upper_N_per_kN},
                              {"is_met", limit.is_met},
                              {"probability", limit.probability}});
  }
  if (!label.warnings.empty()) json["warnings"] = label.warnings;
  return json;
}

std::string format_label(const TireLabel& label, const std::string& source) {
  Table summary{"", {}, {}};
  summary.rows = {{"Class of the tire", label.tire_class},
                  {"RRc", fmt::format("{:.3f} N/kN ({}), standard uncertainty {:.3f} N/kN", label.rrc_N_per_kN, source,
                                      label.rrc_sd_N_per_kN)},
                  {"RRc as declared", fmt::format("{:.1f} N/kN", label.declared_rrc_N_per_kN)},
                  {"EU label class", label.label_class}};
  Table classes{"Classes of the label", {"class", "RRc up to N/kN", "probability"}, {}};
  for (const LabelClassShare& one : label.classes) {
    classes.rows.push_back({one.name, one.upper_N_per_kN.has_value() ? fmt::format("{:.1f}", *one.upper_N_per_kN) : "-",
                            fmt::format("{:.3f}", one.probability)});
  }
  Table limits{"Limits of UN R117", {"stage", "RRc up to N/kN", "met", "probability"}, {}};
  for (const ApprovalLimit& limit : label.limits) {
    limits.rows.push_back({fmt::format("{}", limit.stage), fmt::format("{:.1f}", limit.upper_N_per_kN),
                           limit.is_met ? "yes" : "no", fmt::format("{:.3f}", limit.probability)});
  }
  return fmt::format("label   class {}\n", label.label_class) + format_tables({summary, classes, limits}) +
         format_warnings(label.warnings);
}

}  // namespace

TireLabel make_label(const LabelInput& input) {
  std::optional<models::TireFile> tire;
  if (!input.tire.empty()) tire = models::read_tire(read_config(find_asset("tires", input.tire)));
  const models::ServiceDescription service = find_label_service(input, tire);
  TireLabel label;
  const double rrc = find_label_rrc(input, tire, service, label.warnings);
  fill_label(service, rrc, find_label_rrc_sd(input, service.tire_class), label);
  const std::optional<std::string> doubt = models::doubt_class_by_index(service);
  const bool is_new = std::find(label.warnings.begin(), label.warnings.end(), doubt) == label.warnings.end();
  if (doubt.has_value() && is_new) label.warnings.push_back(*doubt);
  if (!input.load_index.empty()) {
    const auto dual =
        scenarios::doubt_class_by_size(label.tire_class, false, scenarios::parse_service_description(input.load_index));
    if (dual.has_value()) label.warnings.push_back(*dual);
  }
  label.text = format_label(label, input.rrc_N_per_kN.has_value() ? "given" : "simulated test of ISO 28580");
  label.json = to_text(make_label_json(label));
  return label;
}

}  // namespace rollrig
