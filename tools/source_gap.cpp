#include "tools/source_gap.h"

#include <algorithm>
#include <boost/math/interpolators/makima.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>

#include "diagnosis/terms/hypothesis.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"
#include "tools/published_numbers.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

const std::array<const char*, 3> kKinds{"city", "highway", "constant"};
constexpr double kTrustedFrom_km_h = 20.0;  // §4.2.1
constexpr double kFirst_u = -3.0;
constexpr double kLast_u = 6.0;
constexpr double kStep_u = 0.75;

/// One drive of §3.4.4, sample by sample.
struct DrivenPower {
  std::vector<double> speed_m_s;
  std::vector<double> loss_N;     // between hub and roller
  std::vector<double> rolling_N;  // of the tire alone
  std::vector<std::size_t> kind;  // of section; kKinds.size() for none
};

DrivenPower drive(const std::string& tire, const std::vector<models::ActiveEffect>& effects) {
  scenarios::RunSpec spec = make_source_drive(tire);
  spec.effects = effects;
  const sim::Recording<double> recording = scenarios::run_scenario(spec, {}).recording;
  DrivenPower driven;
  std::vector<std::size_t> kind_of_phase;
  for (const sim::PhaseSpan& span : recording.phases) {
    std::size_t kind = 0;
    while (kind < kKinds.size() && span.name.rfind(kKinds[kind], 0) != 0) ++kind;
    kind_of_phase.push_back(kind);
  }
  for (const std::size_t phase : recording.phase) driven.kind.push_back(kind_of_phase[phase]);
  driven.speed_m_s = recording.channel(models::quantities::kSpeed);
  driven.loss_N = recording.channel(models::quantities::kLossForce);
  driven.rolling_N = recording.channel(models::quantities::kRollingResistance);
  return driven;
}

/// Mean error of the model's power by kind of section.
std::array<double, 3> compare(const DrivenPower& model, const DrivenPower& measured) {
  std::array<double, 3> sum{};
  std::array<double, 3> count{};
  for (std::size_t i = 0; i < model.kind.size(); ++i) {
    if (model.kind[i] >= kKinds.size() || 3.6 * model.speed_m_s[i] < kTrustedFrom_km_h) continue;
    const double more_N = measured.loss_N[i] - model.loss_N[i];
    if (!std::isfinite(more_N)) continue;
    sum[model.kind[i]] += -more_N / (model.rolling_N[i] + more_N);
    count[model.kind[i]] += 1.0;
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= count[k];
  return sum;
}

models::ActiveEffect make_active(const models::Effect& effect, double size_u, int sign) {
  models::ActiveEffect active{&effect, {}};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    active.parameters.push_back(
        diagnosis::from_prior_units(effect.info.parameters[i], i == 0 ? size_u : 0.0, i == 0 ? sign : 1).value_SI);
  }
  return active;
}

using Errors = std::vector<double>;

Errors flatten(const PowerErrors& errors, std::optional<std::size_t> tire = std::nullopt) {
  Errors flat;
  for (std::size_t t = 0; t < errors.size(); ++t) {
    if (!tire || *tire == t) flat.insert(flat.end(), errors[t].begin(), errors[t].end());
  }
  return flat;
}

/// The errors of a curve between its sizes.
class SmoothCurve {
 public:
  SmoothCurve(const GapCurve& curve, std::optional<std::size_t> tire) {
    for (std::size_t k = 0; k < flatten(curve.error.front(), tire).size(); ++k) {
      std::vector<double> u = curve.u;
      std::vector<double> values;
      for (const PowerErrors& one : curve.error) values.push_back(flatten(one, tire)[k]);
      of_cell_.emplace_back(std::move(u), std::move(values));
    }
  }
  Errors at(double u) const {
    Errors errors;
    for (const auto& cell : of_cell_) errors.push_back(cell(u));
    return errors;
  }

 private:
  std::vector<boost::math::interpolators::makima<std::vector<double>>> of_cell_;
};

double mean_square(const Errors& a, const Errors& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// The best size between the curve's ends: the best of a fine grid, then Brent's method around it.
template <class Cost>
double minimize(const GapCurve& curve, const Cost& cost) {
  constexpr int kGrid = 200;
  const double first = curve.u.front();
  const double last = curve.u.back();
  const double step = (last - first) / kGrid;
  double best = first;
  for (int i = 1; i <= kGrid; ++i) {
    const double u = std::min(last, first + i * step);
    if (cost(u) < cost(best)) best = u;
  }
  constexpr int kBits = 24;
  return boost::math::tools::brent_find_minima(cost, std::max(first, best - step), std::min(last, best + step), kBits)
      .first;
}

double calc_log_weight(const Errors& errors, const Errors& wanted, double u) {
  constexpr double kSd = 0.02;
  const double chi2 = mean_square(errors, wanted) * static_cast<double>(wanted.size()) / (kSd * kSd);
  return -0.5 * chi2 - 0.5 * u * u;
}

/// The best log weight with one size, of one tire or of all.
double find_log_weight(const GapCurve& curve, const Errors& wanted, std::optional<std::size_t> tire) {
  const SmoothCurve smooth(curve, tire);
  const auto cost = [&](double u) { return -calc_log_weight(smooth.at(u), wanted, u); };
  return -cost(minimize(curve, cost));
}

GapMatch match(const GapCurve& curve, const Errors& wanted, std::optional<std::size_t> tire) {
  const SmoothCurve smooth(curve, tire);
  GapMatch found;
  found.u = minimize(curve, [&](double u) { return mean_square(smooth.at(u), wanted); });
  const models::EffectParameter& size = curve.effect->info.parameters.front();
  found.size = diagnosis::from_prior_units(size, found.u, curve.sign).value_SI / unit_of_key(size.key).factor;
  found.rms_points = 100.0 * std::sqrt(mean_square(smooth.at(found.u), wanted));
  constexpr double kNear_u = 0.01;
  found.at_end = found.u < curve.u.front() + kNear_u || found.u > curve.u.back() - kNear_u;
  return found;
}

GapCandidate match_all(const GapCurve& curve, const PowerErrors& wanted) {
  GapCandidate candidate;
  candidate.effect = curve.effect;
  const auto& hooks = curve.effect->hooks<double>();
  candidate.is_of_tire = hooks.loss != nullptr || hooks.thermal != nullptr || hooks.gas != nullptr;
  candidate.common = match(curve, flatten(wanted), std::nullopt);
  candidate.log_weight = find_log_weight(curve, flatten(wanted), std::nullopt);
  double of_tires = 0.0;
  for (std::size_t t = 0; t < kTires.size(); ++t) {
    candidate.of_tire[t] = match(curve, flatten(wanted, t), t);
    of_tires += find_log_weight(curve, flatten(wanted, t), t);
  }
  if (candidate.is_of_tire) candidate.log_weight = std::max(candidate.log_weight, of_tires);
  return candidate;
}

/// Leaves the sizes about the middle of the prior that can be simulated: beyond them a tire may give out, such as with
/// a loss that takes all the drive has.
void keep_simulated(const std::vector<char>& failed, GapCurve& curve) {
  const auto middle = static_cast<std::size_t>(std::lower_bound(curve.u.begin(), curve.u.end(), 0.0) - curve.u.begin());
  std::size_t first = middle;
  std::size_t last = middle;
  while (first > 0 && failed[first - 1] == 0) --first;
  while (last < failed.size() && failed[last] == 0) ++last;
  const auto cut = [first, last](auto& values) {
    values = {values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(last)};
  };
  cut(curve.u);
  cut(curve.error);
}

bool acts(const GapCurve& curve) {
  constexpr std::size_t kLeast = 4;  // sizes that a smooth curve needs
  if (curve.u.size() < kLeast) return false;
  double most = 0.0;
  for (const PowerErrors& one : curve.error) {
    for (const double error : flatten(one)) most = std::max(most, std::abs(error));
  }
  constexpr double kNothing = 1e-3;
  return most > kNothing;
}

}  // namespace

PowerErrors read_table_4_3(const std::string& folder) {
  PowerErrors errors{};
  for (std::size_t t = 0; t < kTires.size(); ++t) {
    read_published_table(folder + "/table_4_3/expected.toml", kTires[t], [&, t](TableReader& reader) {
      errors[t] = {reader.number({"city_percent", positive(), ""}), reader.number({"highway_percent", positive(), ""}),
                   reader.number({"constant_speed_percent", positive(), ""})};
    });
  }
  return errors;
}

std::vector<GapCurve> simulate_gap_curves(const std::vector<const models::Effect*>& effects) {
  std::vector<GapCurve> curves;
  for (const models::Effect* effect : effects) {
    if (!effect->info.acts_on(rigs::find_machine_kind("dyno").traits)) continue;
    for (const int sign : diagnosis::possible_signs(effect->info.parameters.front())) {
      GapCurve curve{effect, sign, {}, {}};
      for (double u = kFirst_u; u <= kLast_u + 1e-9; u += kStep_u) {
        if (diagnosis::from_prior_units(effect->info.parameters.front(), u, sign).allowed) curve.u.push_back(u);
      }
      curve.error.resize(curve.u.size());
      curves.push_back(std::move(curve));
    }
  }
  std::array<DrivenPower, kTires.size()> models;
  for (std::size_t t = 0; t < kTires.size(); ++t) models[t] = drive(kTires[t], {});
  std::vector<std::pair<std::size_t, std::size_t>> tasks;  // curve, size
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t i = 0; i < curves[c].u.size(); ++i) tasks.emplace_back(c, i);
  }
  std::vector<std::vector<char>> failed;
  for (const GapCurve& curve : curves) failed.emplace_back(curve.u.size(), 0);
  parallel_for(tasks.size(), 0, [&](std::size_t task) {
    GapCurve& curve = curves[tasks[task].first];
    const std::size_t i = tasks[task].second;
    const models::ActiveEffect active = make_active(*curve.effect, curve.u[i], curve.sign);
    try {
      for (std::size_t t = 0; t < kTires.size(); ++t) {
        curve.error[i][t] = compare(models[t], drive(kTires[t], {active}));
      }
    } catch (const RunFailure&) {
      failed[tasks[task].first][i] = 1;
    }
  });
  for (std::size_t c = 0; c < curves.size(); ++c) keep_simulated(failed[c], curves[c]);
  return curves;
}

std::vector<GapCandidate> rank_gap(const std::vector<GapCurve>& curves, const PowerErrors& table, bool measured_above) {
  PowerErrors wanted = table;
  for (auto& tire : wanted) {
    // Relative to the measured power: above the model's, the model is too low.
    for (double& error : tire) error = measured_above ? -error : error;
  }
  std::map<const models::Effect*, GapCandidate> best;
  for (const GapCurve& curve : curves) {
    if (!acts(curve)) continue;
    const GapCandidate candidate = match_all(curve, wanted);
    const auto [it, fresh] = best.emplace(curve.effect, candidate);
    if (!fresh && candidate.log_weight > it->second.log_weight) it->second = candidate;
  }
  std::vector<GapCandidate> ranked;
  for (const auto& one : best) ranked.push_back(one.second);
  std::sort(ranked.begin(), ranked.end(), [](const GapCandidate& a, const GapCandidate& b) {
    if (a.log_weight != b.log_weight) return a.log_weight > b.log_weight;
    return a.effect->info.id < b.effect->info.id;
  });
  return ranked;
}

}  // namespace rollrig::tools
