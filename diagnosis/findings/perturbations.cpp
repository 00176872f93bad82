#include "diagnosis/findings/perturbations.h"

#include <algorithm>
#include <map>

#include "diagnosis/kinds/measurement_kind.h"
#include "models/reference_conditions.h"
#include "models/tire_channels.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

using models::EffectView;
using models::Instant;

static_assert(kPerturbationKnots == static_cast<std::size_t>(kJetWidth),
              "a pass differentiates by one family's perturbations");

/// The interval between knots in which a time lies; of two knots at that time, the one after them.
template <class GetKnot>
std::size_t find_interval(double elapsed_s, GetKnot&& knot_s) {
  std::size_t i = 0;
  while (i + 2 < kPerturbationKnots && knot_s(i + 1) <= elapsed_s) ++i;
  return i;
}

/// What all perturbations share: the knots, then the perturbation at each, in the family's unit; the time as a state.
struct TimePerturbation {
  static models::EffectInfo describe(const char* name) {
    models::EffectInfo info;
    info.id = name;
    info.summary = "A probe of one balance";
    const models::EffectParameter knot{"knot_s", {}, {}, "time of a knot"};
    const models::EffectParameter size{"size", {}, {-1.0, 1.0}, "perturbation at a knot", 0.0};
    info.parameters.assign(kPerturbationKnots, knot);
    info.parameters.insert(info.parameters.end(), kPerturbationKnots, size);
    info.states = {{"elapsed_s", 1000.0, "time since the run's start"}};
    return info;
  }

  template <class S>
  static void rates(const EffectView<S>&, const Instant<S>&, S* rates) {
    rates[0] = S(1.0);
  }

  /// In proportion to `unit`.
  template <class S>
  static S calc(const EffectView<S>& self, const S& unit) {
    const S& elapsed_s = self.state(0);
    const std::size_t i =
        find_interval(value_of(elapsed_s), [&](std::size_t knot) { return value_of(self.parameter(knot)); });
    const S share = (elapsed_s - self.parameter(i)) / (self.parameter(i + 1) - self.parameter(i));
    const S& before = self.parameter(kPerturbationKnots + i);
    const S& after = self.parameter(kPerturbationKnots + i + 1);
    return (before + share * (after - before)) * unit;
  }
};

struct ForcePerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("force"); }
  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>&, models::ParasiticPort<S>& port) {
    port.extra_force_N += calc(self, quantity<S>(1.0, dimension::kForce));
  }
};

struct SlipPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("slip"); }
  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, models::ParasiticPort<S>& port) {
    const S share = now.recorded.longitudinal_force_N / quantity<S>(1000.0, dimension::kForce);
    port.extra_force_N += share * share * calc(self, quantity<S>(1.0, dimension::kForce));
  }
};

struct InertiaPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("inertia"); }
  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, models::ParasiticPort<S>& port) {
    const S share = now.recorded.acceleration_m_s2 / quantity<S>(1.0, dimension::kAcceleration);
    port.extra_force_N += share * calc(self, quantity<S>(1.0, dimension::kForce));
  }
};

struct DragPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("air drag"); }
  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, models::ParasiticPort<S>& port) {
    const S share = now.recorded.speed_m_s / models::get_reference_speed_m_s<S>();
    port.extra_force_N += share * share * calc(self, quantity<S>(1.0, dimension::kForce));
  }
};

struct TireLossPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("tire loss"); }
  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>&, models::LossPort<S>& port) {
    port.add_heating_force(calc(self, quantity<S>(1.0, dimension::kForce)));
  }
};

template <class S>
S one_watt() {
  return quantity<S>(1.0, dimension::kForce * dimension::kSpeed);
}

struct TireHeatPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("tire heat"); }
  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, models::ThermalPort<S>& port) {
    models::add_tire_heat(now, models::HeatSource::kHysteresis, calc(self, one_watt<S>()), port);
  }
};

struct GasHeatPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("gas heat"); }
  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>&, models::ThermalPort<S>& port) {
    port.heat_W[models::index_of(models::Node::kGas)] += calc(self, one_watt<S>());
  }
};

struct GasMassPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("gas mass"); }
  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>&, models::GasPort<S>& port) {
    port.mass_ratio += calc(self, S(1.0));
  }
};

struct BoundaryPerturbation : TimePerturbation {
  static models::EffectInfo info() { return describe("boundary"); }
  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, models::InputPort<S>& port) {
    const S rise_K = calc(self, quantity<S>(1.0, dimension::kTemperature));
    port.ambient_K += rise_K;
    port.surface_K += rise_K;
  }
};

/// A perturbation as a term of a hypothesis: its own parameters are the sizes at the knots, in which a run is cut.
class PerturbationTerm : public Term {
 public:
  template <class E>
  static PerturbationTerm make() {
    return PerturbationTerm(models::make_effect<E>());
  }
  const models::EffectInfo& info() const override { return info_; }
  const models::Effect& effect() const override { return effect_; }
  std::vector<double> list_known(const PreparedRun& run) const override { return find_perturbation_knots(run); }

 private:
  explicit PerturbationTerm(models::Effect effect) : effect_(std::move(effect)), info_(effect_.info) {
    info_.parameters.erase(info_.parameters.begin(), info_.parameters.begin() + kPerturbationKnots);
  }

  models::Effect effect_;
  models::EffectInfo info_;
};

const Term& find_term(Perturbation perturbation) {
  static const std::map<Perturbation, PerturbationTerm> terms{
      {Perturbation::kForce, PerturbationTerm::make<ForcePerturbation>()},
      {Perturbation::kTireLoss, PerturbationTerm::make<TireLossPerturbation>()},
      {Perturbation::kTireHeat, PerturbationTerm::make<TireHeatPerturbation>()},
      {Perturbation::kGasHeat, PerturbationTerm::make<GasHeatPerturbation>()},
      {Perturbation::kGasMass, PerturbationTerm::make<GasMassPerturbation>()},
      {Perturbation::kBoundary, PerturbationTerm::make<BoundaryPerturbation>()},
      {Perturbation::kSlip, PerturbationTerm::make<SlipPerturbation>()},
      {Perturbation::kInertia, PerturbationTerm::make<InertiaPerturbation>()},
      {Perturbation::kDrag, PerturbationTerm::make<DragPerturbation>()}};
  return terms.at(perturbation);
}

/// A part of a run in which a perturbation is continuous.
struct Piece {
  double start_s;
  double end_s;
  std::size_t intervals = 1;

  double length_s() const { return end_s - start_s; }
  double step_s() const { return length_s() / static_cast<double>(intervals); }
};

std::vector<Piece> find_pieces(const PreparedRun& run) {
  const std::vector<double>& time_s = run.measured.time_s;
  std::vector<Piece> pieces;
  for (const RunPhase& phase : run.phases) {
    const std::size_t end = std::min(phase.last, time_s.size() - 1);
    const Piece piece{time_s[phase.first] - time_s.front(), time_s[end] - time_s.front()};
    if (piece.length_s() > 0.0) pieces.push_back(piece);
  }
  while (2 * pieces.size() > kPerturbationKnots) {
    const auto shorter = [](const Piece& a, const Piece& b) { return a.length_s() < b.length_s(); };
    const auto shortest = std::min_element(pieces.begin(), pieces.end(), shorter);
    const bool is_first = shortest == pieces.begin();
    const bool into_next = is_first || (shortest + 1 != pieces.end() && shorter(*(shortest + 1), *(shortest - 1)));
    if (into_next) (shortest + 1)->start_s = shortest->start_s;
    if (!into_next) (shortest - 1)->end_s = shortest->end_s;
    pieces.erase(shortest);
  }
  return pieces;
}

/// A sensor's own perturbation: it moves its channel alone.
PerturbationFamily perturb_sensor(const PreparedSet& set, std::size_t channel, const std::string& name,
                                  const std::vector<std::vector<double>>& knots_s) {
  PerturbationFamily family{name, RowMatrix::Zero(to_index(set.residual_count()), to_index(kPerturbationKnots))};
  for (const Series& series : set.series()) {
    if (series.channel != channel) continue;
    const std::vector<double>& of_run = knots_s[series.run];
    const double start_s = set.runs()[series.run].measured.time_s.front();
    for (std::size_t k = 0; k < series.size(); ++k) {
      const double elapsed_s = series.time_s[k] - start_s;
      const std::size_t i = find_interval(elapsed_s, [&](std::size_t knot) { return of_run[knot]; });
      const double share = (elapsed_s - of_run[i]) / (of_run[i + 1] - of_run[i]);
      family.columns(to_index(series.first_residual + k), to_index(i)) = 1.0 - share;
      family.columns(to_index(series.first_residual + k), to_index(i + 1)) = share;
    }
  }
  return family;
}

}  // namespace

std::vector<double> find_perturbation_knots(const PreparedRun& run) {
  std::vector<Piece> pieces = find_pieces(run);
  for (std::size_t knots = 2 * pieces.size(); knots < kPerturbationKnots; ++knots) {
    const auto coarser = [](const Piece& a, const Piece& b) { return a.step_s() < b.step_s(); };
    ++std::max_element(pieces.begin(), pieces.end(), coarser)->intervals;
  }
  std::vector<double> knots_s;
  for (const Piece& piece : pieces) {
    for (std::size_t i = 0; i < piece.intervals; ++i) {
      knots_s.push_back(piece.start_s + static_cast<double>(i) * piece.step_s());
    }
    knots_s.push_back(piece.end_s);
  }
  return knots_s;
}

std::vector<PerturbationFamily> calc_perturbations(const Study& study) {
  const PreparedSet& set = study.set;
  std::vector<PerturbationFamily> families;
  std::vector<Model> models;
  for (const NamedPerturbation& one : set.kind().perturbations()) {
    families.push_back({one.name, RowMatrix::Zero(to_index(set.residual_count()), to_index(kPerturbationKnots))});
    models.push_back(study.make_model({{{&find_term(one.perturbation), 1}}}));
  }
  Eigen::VectorXd unknowns(to_index(kPerturbationKnots + study.base.size()));
  unknowns << Eigen::VectorXd::Zero(to_index(kPerturbationKnots)),
      study.null.fit.unknowns.head(to_index(study.base.size()));
  parallel_for(set.runs().size() * models.size(), study.settings.threads, [&](std::size_t job) {
    const std::size_t f = job % models.size();
    if (models[f].derive_run(job / models.size(), unknowns, families[f].columns)) return;
    throw RunFailure("a perturbation of the fitted baseline cannot be simulated");
  });
  std::vector<std::vector<double>> knots_s;
  for (const PreparedRun& run : set.runs()) knots_s.push_back(find_perturbation_knots(run));
  for (std::size_t channel = 0; channel < set.channels().size(); ++channel) {
    const auto* of_tire = models::find_tire_channel(set.channels()[channel]);
    if (of_tire != nullptr) families.push_back(perturb_sensor(set, channel, of_tire->sensor, knots_s));
  }
  return families;
}

}  // namespace rollrig::diagnosis
