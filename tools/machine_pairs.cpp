#include "tools/machine_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "models/tire/conversion_laws.h"
#include "models/tire/own_number.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

constexpr std::size_t kAlignmentTires = 5, kFurtherTires = 5, kRepeats = 4;
constexpr double kLeastTarget_N_per_kN = 6.5, kTargetStep_N_per_kN = 1.1;
constexpr const char* kBaseTire = "c1_205_55r16";

/// A tire of the study: the shipped one with other numbers.
struct PairTire {
  double load_N = 0.0, pressure_kPa = 0.0;
  double loss_factor = 1.0, fall_factor = 1.0, speed_rise_factor = 1.0;
  double texture_factor = 1.0;  // over the mean of the tires, where the drums have another texture
};

/// What a machine does to a test.
struct Machine {
  std::vector<std::string> settings;  // effects
  std::string rig = "drum_2m";
  double probe_error_K = 0.0;   // recorded air less true
  double texture_factor = 1.0;  // of the loss
};

/// What differs from one measurement to the next.
struct Scatter {
  double ambient_K = 0.0, pressure_kPa = 0.0, load_share = 0.0, reading_N_per_kN = 0.0;
};

double draw_between(RandomStream& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// On a log scale, as the catalog's usual ranges are.
double draw_log(RandomStream& random, double low, double high) {
  return std::exp(draw_between(random, std::log(low), std::log(high)));
}

double draw_sign(RandomStream& random) { return random.uniform() < 0.5 ? -1.0 : 1.0; }

Scatter draw_scatter(RandomStream& random) {
  return {0.5 * random.normal(), random.normal(), 0.003 * random.normal(), 0.02 * random.normal()};
}

/// The ISO test of the shipped tire.
const models::Iso28580Reference& find_base_test() {
  static const models::Iso28580Reference test = *make_spec("iso_28580", kBaseTire).tire.iso_28580;
  return test;
}

/// A tire near a coefficient. A tire with more loss runs warmer, which the power makes up for roughly.
PairTire draw_tire(RandomStream& random, double target_N_per_kN, TireLoads loads) {
  const models::Iso28580Reference& base = find_base_test();
  PairTire tire;
  tire.load_N = loads == TireLoads::kAlike ? base.load_N : draw_between(random, 3000.0, 6000.0);
  tire.pressure_kPa = base.pressure_Pa / 1e3;
  tire.loss_factor = std::pow(1e-3 * target_N_per_kN / base.rrc, 1.2);
  tire.fall_factor = std::exp(0.15 * random.normal());
  tire.speed_rise_factor = std::exp(0.2 * random.normal());
  tire.texture_factor = 1.0 + 0.005 * random.normal();
  return tire;
}

/// The whole test on a machine, as its own record shows it.
double measure(const Machine& machine, const PairTire& tire, const Scatter& scatter) {
  const double ambient_degC = 25.0 + scatter.ambient_K;
  std::vector<std::string> settings = machine.settings;
  settings.push_back(fmt::format("ambient_degC={}", ambient_degC));
  settings.push_back(fmt::format("load_N={}", tire.load_N * (1.0 + scatter.load_share)));
  settings.push_back(fmt::format("pressure_kPa={}", tire.pressure_kPa + scatter.pressure_kPa));
  scenarios::RunSpec spec = make_spec("iso_28580", kBaseTire, settings, {{"rig", machine.rig}});
  const bool has_texture = machine.texture_factor != 1.0;
  const auto scale = [&spec](const char* key, double factor) {
    *models::find_own_number(spec.tire.values.own, key) *= factor;
  };
  scale("loss_N", tire.loss_factor * machine.texture_factor * (has_texture ? tire.texture_factor : 1.0));
  scale("fall_per_degC", tire.fall_factor);
  scale("speed_rise", tire.speed_rise_factor);
  const double rrc = number(scenarios::run_scenario(spec, {}).result, "rrc_25degC_2m_N_per_kN");
  const double true_K = kZeroCelsius_K + ambient_degC;
  return rrc / models::calc_ambient_correction(true_K) *
             models::calc_ambient_correction(true_K + machine.probe_error_K) +
         scatter.reading_N_per_kN;
}

std::string set_effect(const char* effect, const char* parameter, double value) {
  return fmt::format("effects.{}.{}={}", effect, parameter, value);
}

using DrawMachine = Machine (*)(RandomStream& random);

Machine draw_bearing(RandomStream& random) {
  Machine machine;
  machine.settings = {set_effect("bearing_warmup", "fall_per_K", draw_log(random, 0.005, 0.04)),
                      set_effect("bearing_warmup", "time_constant_min", draw_log(random, 10.0, 60.0)),
                      set_effect("bearing_warmup", "rise_dK", draw_log(random, 8.0, 25.0)),
                      set_effect("bearing_warmup", "reference_share", draw_between(random, 0.5, 1.5)),
                      set_effect("bearing_warmup", "quadratic_share", draw_between(random, 0.2, 1.0))};
  return machine;
}

Machine draw_load_cell(RandomStream& random) {
  Machine machine;
  machine.settings = {set_effect("load_record", "error_percent", draw_sign(random) * draw_log(random, 1.0, 5.0)),
                      set_effect("load_record", "offset_share", draw_between(random, 0.0, 0.5)),
                      set_effect("load_record", "power", draw_between(random, 0.6, 1.4))};
  return machine;
}

Machine draw_force_cell(RandomStream& random) {
  Machine machine;
  machine.settings = {set_effect("torque_gain", "gain_percent", draw_between(random, -2.0, 2.0)),
                      set_effect("torque_gain", "power", draw_between(random, -0.2, 0.2))};
  return machine;
}

Machine draw_cross_talk(RandomStream& random) {
  Machine machine;
  machine.settings = {set_effect("load_cross_talk", "angle_mrad", draw_sign(random) * draw_log(random, 0.05, 0.5)),
                      set_effect("load_cross_talk", "bending_share", draw_between(random, 0.0, 0.3))};
  return machine;
}

Machine draw_probe(RandomStream& random) {
  Machine machine;
  machine.probe_error_K = draw_between(random, -2.0, 2.0);
  return machine;
}

Machine draw_drum(RandomStream& random) {
  Machine machine;
  machine.rig = "drum_1m7";
  machine.settings = {set_effect("curvature_exponent", "exponent", draw_between(random, 0.6, 1.4))};
  return machine;
}

Machine draw_texture(RandomStream& random) {
  Machine machine;
  machine.texture_factor = 1.0 + draw_between(random, 0.02, 0.08);
  return machine;
}

Machine draw_speed(RandomStream& random) {
  Machine machine;
  machine.settings = {set_effect("speed_record", "error_percent", draw_sign(random) * draw_log(random, 1.0, 10.0)),
                      set_effect("speed_record", "growing_share", draw_between(random, -0.3, 0.3)),
                      set_effect("speed_record", "fixed_share", draw_between(random, -0.2, 0.2))};
  return machine;
}

const std::map<std::string, DrawMachine> kDraws{
    {"bearing_warmup", &draw_bearing},  {"load_record", &draw_load_cell},
    {"torque_gain", &draw_force_cell},  {"load_cross_talk", &draw_cross_talk},
    {"temperature_probe", &draw_probe}, {"drum_diameter", &draw_drum},
    {"texture", &draw_texture},         {"speed_record", &draw_speed}};

/// Coefficients at equal steps, each moved by up to a quarter of a step.
double draw_target(RandomStream& random, std::size_t tire) {
  return kLeastTarget_N_per_kN + kTargetStep_N_per_kN * (static_cast<double>(tire) + draw_between(random, -0.25, 0.25));
}

void measure_repeats(RandomStream& random, const Machine& machine, const PairTire& tire,
                     estimation::TireMeasurements& measured) {
  for (std::size_t i = 0; i < kRepeats; ++i) {
    measured.all.push_back({static_cast<double>(i), measure(machine, tire, draw_scatter(random)), i > 0});
  }
}

estimation::AlignmentFile measure_alignment(RandomStream& random, const Machine& reference, const Machine& candidate,
                                            TireLoads loads) {
  estimation::AlignmentFile file;
  file.rules = estimation::kRulesC1C2;
  file.machine = "candidate";
  file.reference_machine = "reference";
  for (std::size_t i = 0; i < kAlignmentTires; ++i) {
    const PairTire tire = draw_tire(random, draw_target(random, i), loads);
    estimation::AlignmentTire aligned;
    aligned.name = fmt::format("{}", i + 1);
    aligned.tire_class = "C1";
    measure_repeats(random, candidate, tire, aligned.candidate);
    measure_repeats(random, reference, tire, aligned.reference);
    aligned.reference_N_per_kN = aligned.reference.mean();
    file.tires.push_back(aligned);
  }
  std::sort(file.tires.begin(), file.tires.end(),
            [](const auto& a, const auto& b) { return a.candidate.mean() < b.candidate.mean(); });
  return file;
}

double find_quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  return values[static_cast<std::size_t>(std::max(0.0, rank))];
}

}  // namespace

const std::vector<MachineDifference>& list_machine_differences() {
  static const std::vector<MachineDifference> differences{
      {"bearing_warmup", "bearing warm-up", "usual ranges of the catalog"},
      {"load_record", "load cell", "1 to 5 %, either sign"},
      {"torque_gain", "force cell, gain", "-2 to 2 %"},
      {"load_cross_talk", "force cell, cross-talk of the load", "0.05 to 0.5 mrad, either sign"},
      {"temperature_probe", "temperature probe", "error of -2 to 2 K of the recorded air temperature"},
      {"drum_diameter", "drum diameter", "1.707 m instead of 2 m; curvature exponent of the tires 0.6 to 1.4"},
      {"texture", "texture", "2 to 8 % more loss, 0.5 % from tire to tire"},
      {"speed_record", "speed", "1 to 10 %, either sign"}};
  return differences;
}

MachinePair simulate_pair(const std::string& difference, TireLoads loads, std::uint64_t seed, std::size_t index) {
  RandomStream random(seed, fmt::format("{} {}", difference, index));
  const Machine reference;
  const Machine candidate = kDraws.at(difference)(random);
  const estimation::AlignmentFile file = measure_alignment(random, reference, candidate, loads);
  AlignmentInput input;
  input.preliminary = true;  // a range that a draw made too narrow is a case like others
  const estimation::AlignmentResult result = estimation::align_machine(file, input);
  MachinePair pair{difference, result.line.A2, result.line.B2, result.sigma_m.sd, result.fit.lack_of_fit_p, {}};
  for (std::size_t i = 0; i < kFurtherTires; ++i) {
    const PairTire tire = draw_tire(random, draw_target(random, i), loads);
    AlignedCase one;
    one.reference_N_per_kN = measure(reference, tire, {});
    one.measured_N_per_kN = measure(candidate, tire, draw_scatter(random));
    const estimation::UncertainValue aligned = estimation::align_value(result.line, one.measured_N_per_kN, 1);
    one.aligned_N_per_kN = aligned.value;
    one.half_width_N_per_kN = aligned.coverage_factor * aligned.sd;
    pair.cases.push_back(one);
  }
  return pair;
}

std::vector<MachinePair> simulate_pairs(const std::vector<std::string>& differences, TireLoads loads, std::size_t pairs,
                                        std::uint64_t seed, const std::function<void(double)>& advance) {
  std::vector<MachinePair> all(differences.size() * pairs);
  parallel_for(
      all.size(), 0, [&](std::size_t i) { all[i] = simulate_pair(differences[i / pairs], loads, seed, i % pairs); },
      advance);
  return all;
}

double find_share_within(const std::vector<MachinePair>& pairs, double limit_N_per_kN) {
  double within = 0.0, count = 0.0;
  for (const MachinePair& pair : pairs) {
    for (const AlignedCase& one : pair.cases) {
      within += std::abs(one.error()) <= limit_N_per_kN ? 1.0 : 0.0;
      count += 1.0;
    }
  }
  return within / count;
}

std::string make_pair_table(const std::vector<MachinePair>& pairs) {
  std::string table =
      "| difference | size | pairs | 95th percentile of the absolute difference before | 95th percentile of the "
      "absolute difference after "
      "| within 0.1 N/kN | within expanded uncertainty U (95 %) | lack of fit found "
      "|\n|---|---|---|---|---|---|---|---|\n";
  const auto add_row = [&table](const std::string& title, const std::string& drawn,
                                const std::vector<MachinePair>& of_row) {
    if (of_row.empty()) return;
    std::vector<double> before, after;
    double covered = 0.0, bent = 0.0;
    for (const MachinePair& pair : of_row) {
      bent += pair.lack_of_fit_p < 0.05 ? 1.0 : 0.0;
      for (const AlignedCase& one : pair.cases) {
        before.push_back(std::abs(one.error_before()));
        after.push_back(std::abs(one.error()));
        covered += after.back() <= one.half_width_N_per_kN ? 1.0 : 0.0;
      }
    }
    table += fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.1f} % | {:.1f} % | {:.0f} % |\n", title, drawn,
                         of_row.size(), find_quantile(before, 0.95), find_quantile(after, 0.95),
                         100.0 * find_share_within(of_row), 100.0 * covered / static_cast<double>(after.size()),
                         100.0 * bent / static_cast<double>(of_row.size()));
  };
  for (const MachineDifference& difference : list_machine_differences()) {
    std::vector<MachinePair> own;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(own),
                 [&difference](const MachinePair& pair) { return pair.difference == difference.name; });
    add_row(difference.title, difference.drawn, own);
  }
  add_row("all", "", pairs);
  return table;
}

}  // namespace rollrig::tools
