#include "tests/support/drum_fixture.h"

#include "build_paths.h"
#include "rigs/standstill_grid.h"
#include "rigs/trace_effects.h"
#include "sim/core/assets.h"

namespace rollrig::tests {

models::TireFile read_asset_tire(const std::string& name) {
  return models::read_tire(read_config(find_asset("tires", name)));
}

std::string combined_tire_path(const std::string& name) {
  return ROLLRIG_SOURCE_DIR "/tests/published/combined_law/" + name + ".toml";
}
models::TireFile read_combined_tire(const std::string& name) {
  return models::read_tire(read_config(combined_tire_path(name)));
}

models::OwnParameters<double> make_own(const std::string& model) {
  models::OwnParameters<double> own{&models::find_tire_model(model), {}};
  for (const models::TireModelParameter& declared : own.model->info.parameters) {
    own.values.push_back(unit_of_key(declared.field.key).to_si(declared.usual));
  }
  return own;
}

rigs::RigFile read_asset_rig() { return rigs::read_rig(read_config(find_asset("rigs", "drum_2m"))); }

rigs::RigStart<double> DrumFixture::start() const {
  rigs::RigStart<double> at;
  at.tire_temperature_K = initial_K;
  at.cold_pressure_Pa = cold_pressure_Pa;
  at.ambient_pressure_Pa = rig.environment.ambient_pressure_Pa;
  return at;
}

sim::Recording<double> DrumFixture::run_multibody(const sim::Program& program) const {
  models::Corner<double> at = corner();
  const auto drum = rigs::make_multibody_drum(at, rig, start(), false);
  sim::CvodesIntegrator integrator(*drum, cvodes);
  sim::Recording<double> recording = sim::simulate<double>(*drum, integrator, program);
  rigs::apply_trace_effects(at, recording);
  return recording;
}

sim::Recording<double> DrumFixture::run_quasi_static(const sim::Program& program) const {
  models::Corner<double> at = corner();
  rigs::QuasiStaticDrum<double> drum(at, start(), false, rigs::Detail::kFull);
  sim::FixedGridIntegrator<double> integrator(drum);
  sim::Recording<double> recording = sim::simulate<double>(
      drum, integrator, rigs::refine_near_standstill(program, rigs::index_of(rigs::DrumInput::kSpeed)));
  rigs::apply_trace_effects(at, recording);
  return recording;
}

sim::Segment drum_segment(double duration_s, double speed_start_m_s, double speed_end_m_s, double load_N,
                          double ambient_K) {
  sim::Segment segment{duration_s, sim::Ramps(rigs::kDrumInputCount)};
  segment.inputs[rigs::index_of(rigs::DrumInput::kSpeed)] = {speed_start_m_s,
                                                             (speed_end_m_s - speed_start_m_s) / duration_s};
  segment.inputs[rigs::index_of(rigs::DrumInput::kLoad)] = {load_N, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kAmbient)] = {ambient_K, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kSurface)] = {ambient_K, 0.0};
  return segment;
}

sim::Phase rolling(const std::string& name, double duration_s, double speed_m_s, double load_N) {
  sim::Phase phase;
  phase.name = name;
  phase.segments = {drum_segment(duration_s, speed_m_s, speed_m_s, load_N)};
  return phase;
}

models::ActiveEffect make_active(const models::Effect& effect, const std::vector<double>& first_values) {
  models::ActiveEffect active{&effect, {}};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    const models::EffectParameter& parameter = effect.info.parameters[i];
    const double value = i < first_values.size() ? first_values[i] : parameter.prior.center();
    active.parameters.push_back(unit_of_key(parameter.key).to_si(value));
  }
  return active;
}

scenarios::RunSpec make_spec(const std::string& scenario, const std::string& tire,
                             const std::vector<std::string>& settings, const std::string& fidelity) {
  ConfigTable document = scenarios::make_run_document(scenario);
  set_config_value(document, "tire", tire, "test");
  set_config_value(document, "fidelity", fidelity, "test");
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  return scenarios::read_run_spec(document, "");
}

scenarios::Outcome run(const std::string& scenario, const std::string& tire, const std::vector<std::string>& settings,
                       const std::string& fidelity) {
  const scenarios::RunSpec spec = make_spec(scenario, tire, settings, fidelity);
  return scenarios::run_scenario(spec, {});
}

double number(const scenarios::Outcome& outcome, const char* key) { return outcome.result[key].get<double>(); }

}  // namespace rollrig::tests
