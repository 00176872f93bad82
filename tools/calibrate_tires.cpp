/// Calibrates the source's tires on the drum rig to the numbers that the source publishes.
///
/// usage: calibrate_tires <published.toml> <tire.toml> [<tire.toml> ...]
/// Fitted for each tire: a scale on A0 and A1, B0, and z on rig drum_2m, so that virtual tests give
///   - RRc_ISO (scenario iso_28580 at the tire's own ISO load and pressure),
///   - the relative fall of the loss over 30 to 35 degC (scenario warm_up at 5400 N, 280 kPa),
///   - the loss at 30 degC in that test, or, where none is published, the start of the warm-up over its
///     end at ISO load.
/// Three numbers by three parameters: nothing is left to predict in them. The files are rewritten in place,
/// number by number; comments stay.
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "scenarios/run_spec.h"
#include "sim/core/file_io.h"

namespace {

using namespace rollrig;

struct Targets {
  double rrc_iso = 0.0;
  double band_B_per_K = 0.0;
  std::optional<double> band_low_N;
  std::optional<double> start_excess;
};

Targets read_targets(const ConfigTable& published, const std::string& tire) {
  TableReader file(published, "");
  check_format(file, "rollrig-published", 1);
  const ConfigTable* table = file.table(tire);
  if (table == nullptr) throw file.problem(tire, "nothing is published of this tire");
  TableReader reader(*table, "[" + tire + "]");
  Targets targets;
  targets.rrc_iso = reader.number({"rrc_iso_N_per_kN", positive(), ""});
  targets.band_B_per_K = reader.number({"band_B_per_degC", positive(), ""});
  targets.band_low_N = reader.number_or_none({"band_low_N", positive(), ""});
  targets.start_excess = reader.number_or_none({"start_excess_percent", positive(), ""});
  reader.finish();
  return targets;
}

/// What is fitted.
struct Calibrated {
  double A_scale = 1.0;
  double B0_per_K = 0.0;
  double z_W_per_K = 0.0;
};

class VirtualTests {
 public:
  VirtualTests(std::string tire_path, Targets targets) : targets_(targets) {
    iso_ = make_spec("iso_28580", tire_path, {});
    warm_up_ = make_spec("warm_up", tire_path, {"load_N=5400", "pressure_kPa=280"});
    warm_up_iso_ = make_spec("warm_up", tire_path, {});
  }

  const models::TireFile& tire() const { return iso_.tire; }

  /// Relative differences to the published numbers.
  bool operator()(const double* x, double* residuals) const {
    const Calibrated at{x[0], x[1], x[2]};
    residuals[0] = number(iso_, at, "rrc_25degC_2m_N_per_kN") / (1e3 * targets_.rrc_iso) - 1.0;
    residuals[1] = number(warm_up_, at, "band_B_per_degC") / targets_.band_B_per_K - 1.0;
    residuals[2] = targets_.band_low_N.has_value()
                       ? number(warm_up_, at, "band_low_N") / *targets_.band_low_N - 1.0
                       : number(warm_up_iso_, at, "start_excess_percent") / (100.0 * *targets_.start_excess) - 1.0;
    return true;
  }

  static void put(const Calibrated& at, models::TireFile& tire) {
    tire.values.rolling_resistance.A0_N *= at.A_scale;
    tire.values.rolling_resistance.A1_N_s_per_m *= at.A_scale;
    tire.values.rolling_resistance.B0_per_K = at.B0_per_K;
    tire.rig_thermal["drum_2m"].z_W_per_K = at.z_W_per_K;
  }

 private:
  static scenarios::RunSpec make_spec(const std::string& scenario, const std::string& tire_path,
                                      const std::vector<std::string>& settings) {
    ConfigTable document = scenarios::make_run_document(scenario);
    set_config_value(document, "tire", "\"" + tire_path + "\"", "calibrate_tires");
    set_config_value(document, "fidelity", "quasi_static", "calibrate_tires");
    for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
    return scenarios::read_run_spec(document, "");
  }

  static double number(scenarios::RunSpec spec, const Calibrated& at, const char* key) {
    put(at, spec.tire);
    const Json value = spec.scenario->run(spec, {}).result[key];
    if (!value.is_number()) throw RunFailure(fmt::format("'{}' could not be read off the virtual test", key));
    return value.get<double>();
  }

  Targets targets_;
  scenarios::RunSpec iso_, warm_up_, warm_up_iso_;
};

Calibrated calibrate(VirtualTests& tests) {
  const models::TireFile& tire = tests.tire();
  double x[3] = {1.0, tire.values.rolling_resistance.B0_per_K, *tire.rig_thermal.at("drum_2m").z_W_per_K};
  ceres::Problem problem;
  problem.AddResidualBlock(
      new ceres::NumericDiffCostFunction<VirtualTests, ceres::CENTRAL, 3, 3>(&tests, ceres::DO_NOT_TAKE_OWNERSHIP),
      nullptr, x);
  ceres::Solver::Options options;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  constexpr double kGoodCost = 1e-12;  // relative residuals below about 1e-6
  if (!(summary.final_cost < kGoodCost)) throw RunFailure("calibration does not converge: " + summary.BriefReport());
  return {x[0], x[1], x[2]};
}

/// Replaces the number of `key` in [table], keeping the comment where it stands.
std::string replace_number(const std::string& text, const std::string& table, const std::string& key, double value) {
  const std::size_t header = text.find("\n[" + table + "]");
  const std::size_t line = text.find("\n" + key + " = ", header);
  if (header == std::string::npos || line == std::string::npos)
    throw RunFailure("no key " + key + " in [" + table + "]");
  const std::size_t end = text.find('\n', line + 1);
  const std::string old = text.substr(line + 1, end - line - 1);
  const std::size_t comment = old.find('#');
  std::string fresh = fmt::format("{} = {:.7g}", key, value);
  constexpr std::size_t kCommentColumn = 38;  // as in the assets
  if (comment != std::string::npos) fresh = fmt::format("{:<{}}{}", fresh, kCommentColumn, old.substr(comment));
  return text.substr(0, line + 1) + fresh + text.substr(end);
}

void calibrate_file(const ConfigTable& published, const std::string& path) {
  std::string text = read_text_file(path);
  VirtualTests tests(path, read_targets(published, models::read_tire(parse_config(text, path)).name));
  const Calibrated found = calibrate(tests);
  models::TireFile tire = tests.tire();
  VirtualTests::put(found, tire);
  const auto& rr = tire.values.rolling_resistance;
  text = replace_number(text, "rolling_resistance", "A0_N", rr.A0_N);
  text = replace_number(text, "rolling_resistance", "A1_N_s_per_m", rr.A1_N_s_per_m);
  text = replace_number(text, "rolling_resistance", "B0_per_degC", rr.B0_per_K);
  text = replace_number(text, "thermal.rig.drum_2m", "z_W_per_K", found.z_W_per_K);
  write_file_atomically(path, text);
  std::cout << fmt::format("{}: A0 {:.4f} N, A1 {:.5f} N s/m, B0 {:.6f} 1/degC, z on drum_2m {:.3f} W/K\n", tire.name,
                           rr.A0_N, rr.A1_N_s_per_m, rr.B0_per_K, found.z_W_per_K);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: calibrate_tires <published.toml> <tire.toml> ...\n";
    return 2;
  }
  try {
    const ConfigTable published = read_config(argv[1]);
    for (int i = 2; i < argc; ++i) calibrate_file(published, argv[i]);
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "calibration failed: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
