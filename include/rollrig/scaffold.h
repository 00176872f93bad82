#pragma once
/// Files for a user's own tire, rig, vehicle and measurement set, from the little that is known of them
/// (docs/own_tire_and_set.md). Each number in a file has its source, or "Assumed:".

#include <string>

#include "bad_rows.h"
#include "fit_options.h"
#include "result.h"
#include "scaffold_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// A report whose files are the tire, the rig, the vehicle or the set. It has no page.
struct NewFiles : Report {
  std::string suspicion;  // of a tire that is fitted to a log: why columns, units or files cannot be right; else empty
};

/// A tire file with the values of its class, scaled so that its simulated test of ISO 28580 gives the RRc.
/// Errors  InputError: a size, load index, class or number that cannot be
NewFiles make_new_tire(const NewTireOptions& options);

/// The same tire, fitted to the log of a warm-up on a rig. What `log` leaves out of tire and rig is the new tire and
/// the 2 m drum.
/// Errors  InputError: what make_new_tire(), guess_set() and fit_tire() refuse; RunFailure: as fit_tire()
NewFiles make_new_tire(const NewTireOptions& options, const GuessOptions& log, const TireFitOptions& fit);

/// A rig file. Throws InputError.
NewFiles make_new_rig(const NewRigOptions& options);

/// A vehicle file. Throws InputError.
NewFiles make_new_vehicle(const NewVehicleOptions& options);

/// For a folder of logs of which nothing is known: import.toml with a comment on each guess, or set.toml where the logs
/// are files of a set as they are. Paths in it are relative to `folder`, in which it is to stand.
/// Errors  InputError: what the logs do not tell, with the option that says it
NewFiles guess_set(const GuessOptions& options, const std::string& folder);

/// The set that import_logs() makes by such a mapping, and the mapping as import.toml beside it. `folder` is that of
/// the set.
NewFiles import_guessed(const GuessOptions& options, const std::string& folder, BadRows bad_rows = BadRows::kRefuse,
                        const Progress& progress = {});

}  // namespace rollrig
#pragma GCC visibility pop
