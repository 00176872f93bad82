/* A tire warms up at 80 km/h: the C API of rollrig from C. */
#include <rollrig/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int status) {
  if (status == ROLLRIG_OK) return;
  fprintf(stderr, "%s\n", rollrig_last_error());
  exit(status);
}

static double get(rollrig_wheel* tire, const char* name) {
  double value = 0.0;
  check(rollrig_wheel_get(tire, rollrig_wheel_find_variable(tire, name), &value));
  return value;
}

int main(void) {
  rollrig_wheel* tire = rollrig_wheel_create("a50", "road");
  int minute;
  if (tire == NULL) check(ROLLRIG_INPUT_ERROR);
  check(rollrig_wheel_start(tire, 0.0));
  check(rollrig_wheel_set(tire, rollrig_wheel_find_variable(tire, "speed_m_s"), 80.0 / 3.6));
  printf("min  resistance N  liner degC  pressure kPa\n");
  for (minute = 0; minute <= 30; minute += 10) {
    printf("%3d  %12.2f  %10.1f  %12.1f\n", minute, get(tire, "rolling_resistance_N"),
           get(tire, "liner_temperature_K") - 273.15, 1e-3 * get(tire, "cavity_pressure_Pa"));
    if (minute < 30) check(rollrig_wheel_step(tire, 600.0));
  }
  rollrig_wheel_free(tire);
  return 0;
}
