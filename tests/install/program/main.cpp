// A program of somebody else's: an ISO 28580 test through the installed library.
#include <rollrig/rollrig.h>

#include <cstdio>

int main() {
  try {
    rollrig::RunInput input;
    input.scenario_or_file = "iso_28580";
    input.tire = "a50";
    input.settings = {"speed_km_h=80"};
    const rollrig::RunResult result = rollrig::Run(input).carry_out();
    for (const rollrig::ResultValue& at : result.values) {
      if (at.name == "rrc_25degC_2m_N_per_kN") std::printf("%.17g %s\n", at.number.value_or(0.0), at.unit.c_str());
    }
    std::printf("%s\n", rollrig::find_asset("tires", "a50").c_str());
  } catch (const rollrig::InputError& error) {  // what, file, line, key, value, allowed, nearest
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
