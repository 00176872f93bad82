/// Rolling resistance of a tire over its pressure, as a table. Usage: sweep <tire>
#include <rollrig/rollrig.h>

#include <cstdio>

int main(int argc, char** argv) {
  rollrig::SweepInput input;
  input.run.scenario_or_file = "iso_28580";
  input.run.tire = argc > 1 ? argv[1] : "a50";
  input.run.fidelity = "quasi_static";
  input.axes = {{"pressure_kPa", {"190", "210", "230"}}};
  try {
    const rollrig::SweepResult sweep = rollrig::Sweep(input).carry_out();
    const std::string wanted = "rrc_25degC_2m_N_per_kN";
    for (std::size_t i = 0; i < sweep.points.size(); ++i) {
      for (std::size_t k = 0; k < sweep.results.size(); ++k) {
        if (sweep.results[k] != wanted) continue;
        std::printf("%s kPa  %.3f N/kN\n", sweep.points[i][0].c_str(), sweep.values[i][k]);
      }
    }
  } catch (const rollrig::InputError& error) {  // an unknown tire, say, with the nearest name
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
