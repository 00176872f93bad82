#ifndef ROLLRIG_C_API_H
#define ROLLRIG_C_API_H
/* rollrig for C, and for languages that call C: MATLAB (loadlibrary), Python (ctypes) and others. See docs/c_api.md.

   Texts are UTF-8 and end with a zero. Functions that return int return ROLLRIG_OK or another status; functions that
   return a pointer return a null pointer where they fail. rollrig_last_error() then says why. Two threads may use two
   objects at once, but not one. */

#define ROLLRIG_C_API_VERSION 1

/* Statuses, as exit statuses of the program. */
#define ROLLRIG_OK 0
#define ROLLRIG_INPUT_ERROR 2 /* what the caller gave is wrong; nothing has changed */
#define ROLLRIG_RUN_FAILED 3  /* the simulation cannot go on */
#define ROLLRIG_INTERNAL_ERROR 70

#ifdef __cplusplus
#pragma GCC visibility push(default)
extern "C" {
#endif

/* ROLLRIG_C_API_VERSION of the library. It changes when a function changes or goes away. */
int rollrig_c_api_version(void);

/* Why the last call of this thread failed; valid until its next call. */
const char* rollrig_last_error(void);

/* A warm tire on its wheel, whose motion the caller gives. Its variables have names that end with their units, such as
   "speed_m_s" and "cavity_pressure_Pa", and numbers from 0. */
typedef struct rollrig_wheel rollrig_wheel;

/* tire, rig: the name of an asset, a path, or the text of such a file. */
rollrig_wheel* rollrig_wheel_create(const char* tire, const char* rig);
void rollrig_wheel_free(rollrig_wheel* wheel);

int rollrig_wheel_variable_count(const rollrig_wheel* wheel);
/* Null for a number that no variable has. */
const char* rollrig_wheel_variable_name(const rollrig_wheel* wheel, int variable);
/* "input", "output", "state", "rate", "parameter" or "time". */
const char* rollrig_wheel_variable_role(const rollrig_wheel* wheel, int variable);
/* -1 for a name that no variable has. */
int rollrig_wheel_find_variable(const rollrig_wheel* wheel, const char* name);

/* Inputs may be set at any time, parameters before rollrig_wheel_start() alone. */
int rollrig_wheel_set(rollrig_wheel* wheel, int variable, double value);
int rollrig_wheel_get(rollrig_wheel* wheel, int variable, double* value);
/* Rate of an input through the next step; then it is 0 again. That of the speed is the input acceleration_m_s2, which
   stays. */
int rollrig_wheel_set_slope(rollrig_wheel* wheel, int variable, double slope_per_s);

/* Soaks the tire at its temperature at the start. */
int rollrig_wheel_start(rollrig_wheel* wheel, double time_s);
int rollrig_wheel_step(rollrig_wheel* wheel, double step_s);
/* Back to how it was created. */
int rollrig_wheel_reset(rollrig_wheel* wheel);

/* For a solver of your own: states and their rates, `count` numbers, which is rollrig_wheel_state_count(). */
int rollrig_wheel_state_count(const rollrig_wheel* wheel);
int rollrig_wheel_get_states(rollrig_wheel* wheel, double* states, int count);
int rollrig_wheel_set_states(rollrig_wheel* wheel, const double* states, int count);
int rollrig_wheel_get_rates(rollrig_wheel* wheel, double* rates, int count);
/* Derivatives of outputs, states or rates along a direction of inputs and states. */
int rollrig_wheel_differentiate(rollrig_wheel* wheel, const int* unknown, int unknown_count, const int* known,
                                int known_count, const double* direction, double* derivatives);

/* All of a wheel as bytes, from which one of the same tire and rig goes on. */
int rollrig_wheel_saved_size(const rollrig_wheel* wheel);
int rollrig_wheel_save(const rollrig_wheel* wheel, char* bytes, int size);
int rollrig_wheel_load(rollrig_wheel* wheel, const char* bytes, int size);

/* A whole test, as by `rollrig run`. */
typedef struct rollrig_run rollrig_run;

/* input: JSON with "scenario", which may be a run file, and where wanted "tire", "rig", "vehicle", "fidelity",
   "baseline", "sensors", "seed" (texts), and "settings", an object: {"scenario": "warm_up", "tire": "a50",
   "settings": {"speed_km_h": 120}}. */
rollrig_run* rollrig_run_carry_out(const char* input);
void rollrig_run_free(rollrig_run* run);
/* result.json, as `rollrig run --json` writes it. */
const char* rollrig_run_json(const rollrig_run* run);
int rollrig_run_row_count(const rollrig_run* run);
int rollrig_run_channel_count(const rollrig_run* run);
/* Its heading in recording.csv, which ends with the unit; that of channel 0 is "time_s". */
const char* rollrig_run_channel_name(const rollrig_run* run, int channel);
int rollrig_run_get_channel(const rollrig_run* run, int channel, double* values, int count);

#ifdef __cplusplus
}
#pragma GCC visibility pop
#endif

#endif
