#ifndef ROLLRIG_C_API_H
#define ROLLRIG_C_API_H
/* rollrig for C, and for languages that call C: MATLAB (loadlibrary), Python (ctypes) and others. See docs/c_api.md.

   Texts are UTF-8 and end with a NUL character. There are three kinds of functions:
   - Functions that create an object return it. Where they fail, they return a null pointer.
   - Functions that act (set, get, start, step, reset, differentiate, save, load) return a status.
   - Functions that only tell something return a count, a size, the number of a variable, or a text. For a null object,
     an unknown number or an unknown name, the count or size is 0, the number is -1, and the text is a null pointer.
   rollrig_last_error() says why a function of the first two kinds failed. The third kind does not change it.

   Two threads may use two objects at the same time, but not the same object.

   Free each object once, with rollrig_wheel_free() or rollrig_run_free(). To free a null pointer does nothing. Names
   and other texts of an object are valid until it is freed. */

#define ROLLRIG_C_API_VERSION 1

/* Statuses, as exit statuses of the program. */
#define ROLLRIG_OK 0
#define ROLLRIG_INPUT_ERROR 2     /* what the caller gave is wrong; nothing has changed */
#define ROLLRIG_RUN_FAILED 3      /* the simulation cannot go on; nothing has changed */
#define ROLLRIG_INTERNAL_ERROR 70 /* a mistake in rollrig */

#ifdef __cplusplus
#pragma GCC visibility push(default)
extern "C" {
#endif

/* ROLLRIG_C_API_VERSION of the library. It changes when a function changes or goes away: where it is not that of this
   header, do not call the library. */
int rollrig_c_api_version(void);

/* Why the last call of this thread failed, not counting calls that only tell something. Empty if that call did not
   fail, or if there was no memory for the text. Valid until the next call that counts. */
const char* rollrig_last_error(void);

/* A warm tire on its wheel, without effects, whose motion the caller gives. Its variables have numbers from 0, and
   names that end with their units, such as "speed_m_s" and "cavity_pressure_Pa"; ratios have none. "der(x)" is the rate
   of the state "x", in the unit of "x" per second. docs/fmu.md lists the variables. */
typedef struct rollrig_wheel rollrig_wheel;

/* tire, rig: text with a line break is the content of a file; other text is the name of an asset or a path. */
rollrig_wheel* rollrig_wheel_create(const char* tire, const char* rig);
void rollrig_wheel_free(rollrig_wheel* wheel);

int rollrig_wheel_variable_count(const rollrig_wheel* wheel);
/* Null for a number that no variable has. */
const char* rollrig_wheel_variable_name(const rollrig_wheel* wheel, int variable);
/* "input", "output", "state", "rate", "parameter" or "time". */
const char* rollrig_wheel_variable_role(const rollrig_wheel* wheel, int variable);
/* -1 for a name that no variable has. */
int rollrig_wheel_find_variable(const rollrig_wheel* wheel, const char* name);

/* Inputs may be set at any time, parameters only before rollrig_wheel_start(). value: in the unit of the variable's
   name. Errors: ROLLRIG_INPUT_ERROR for a value that is not allowed, a variable of another role, or a parameter set too
   late. */
int rollrig_wheel_set(rollrig_wheel* wheel, int variable, double value);
/* Outputs and rates are those of the present inputs and states. Errors: ROLLRIG_INPUT_ERROR for an output, a state or a
   rate before rollrig_wheel_start(); ROLLRIG_RUN_FAILED where the equations give no finite number. */
int rollrig_wheel_get(rollrig_wheel* wheel, int variable, double* value);
/* Slope of an input, in its unit per second, through the next step; then it is 0 again. The slope of the speed is the
   input acceleration_m_s2, which stays; the acceleration has no slope. Inputs without a slope hold through a step. */
int rollrig_wheel_set_slope(rollrig_wheel* wheel, int variable, double slope_per_s);

/* Puts the tire at the start: all its temperatures are the parameter start.tire_temperature_degC. After this,
   parameters are fixed. time_s: -1e10 to 1e10. Errors: ROLLRIG_INPUT_ERROR for parameters that contradict each other,
   or another time. */
int rollrig_wheel_start(rollrig_wheel* wheel, double time_s);
/* Goes on by step_s [s], more than 0 and at most 1e5 times steps.longest_s, and up to the time 1e10 s.
   Equations: docs/physics.md, DrivenWheel; Runge-Kutta of order 4. Validity: docs/limits_of_validity.md.
   Errors: ROLLRIG_INPUT_ERROR for a step or a slope that is not allowed, ROLLRIG_RUN_FAILED for a state that no tire
   can have, or one whose steps would have to be shorter than 1e-4 s; after either, nothing has changed. */
int rollrig_wheel_step(rollrig_wheel* wheel, double step_s);
/* Back to how it was created: parameters and inputs have their start values, and may be set. */
int rollrig_wheel_reset(rollrig_wheel* wheel);

/* For a solver of your own: states and their rates, in the units of the variables. count must be
   rollrig_wheel_state_count(). Errors: ROLLRIG_INPUT_ERROR before rollrig_wheel_start(), for another count, or for a
   state that is not finite; ROLLRIG_RUN_FAILED for states that no tire can have. */
int rollrig_wheel_state_count(const rollrig_wheel* wheel);
int rollrig_wheel_get_states(rollrig_wheel* wheel, double* states, int count);
int rollrig_wheel_set_states(rollrig_wheel* wheel, const double* states, int count);
int rollrig_wheel_get_rates(rollrig_wheel* wheel, double* rates, int count);
/* Directional derivative: derivatives[i] = sum over k of d unknown[i] / d known[k] * direction[k], exact (dual
   numbers), in the units of the variables. known: inputs and states; unknown: outputs, states and rates. direction has
   known_count numbers, derivatives unknown_count. Errors: ROLLRIG_INPUT_ERROR before rollrig_wheel_start(), for a
   variable of another role, a negative count, or a direction that is not finite. */
int rollrig_wheel_differentiate(rollrig_wheel* wheel, const int* unknown, int unknown_count, const int* known,
                                int known_count, const double* direction, double* derivatives);

/* All of a wheel as bytes, from which one of the same tire and rig goes on. The size grows at rollrig_wheel_start(). */
int rollrig_wheel_saved_size(const rollrig_wheel* wheel);
/* size must be rollrig_wheel_saved_size(). */
int rollrig_wheel_save(const rollrig_wheel* wheel, char* bytes, int size);
/* size must be that with which the bytes were saved. Errors: ROLLRIG_INPUT_ERROR for other bytes, or those of another
   wheel. */
int rollrig_wheel_load(rollrig_wheel* wheel, const char* bytes, int size);

/* A whole test, as by `rollrig run`. */
typedef struct rollrig_run rollrig_run;

/* input: JSON with "scenario", which may be a run file, and where wanted "tire", "rig", "vehicle", "fidelity",
   "baseline", "sensors", "seed" (texts; the seed may be a number), and "settings", an object: {"scenario": "warm_up", "tire": "a50",
   "settings": {"speed_km_h": 120}}. An object in an object stands for names with a dot: {"effects": {"slow_leak": {}}}
   switches an effect on. What is null is as if it were not there. */
rollrig_run* rollrig_run_carry_out(const char* input);
void rollrig_run_free(rollrig_run* run);
/* result.json, as `rollrig run --json` writes it. */
const char* rollrig_run_json(const rollrig_run* run);
int rollrig_run_row_count(const rollrig_run* run);
int rollrig_run_channel_count(const rollrig_run* run);
/* Its heading in recording.csv, which ends with the unit; that of channel 0 is "time_s". */
const char* rollrig_run_channel_name(const rollrig_run* run, int channel);
/* Values of a channel, in the unit of its name. count must be rollrig_run_row_count(). NaN: no sample. */
int rollrig_run_get_channel(const rollrig_run* run, int channel, double* values, int count);

#ifdef __cplusplus
}
#pragma GCC visibility pop
#endif

#endif
