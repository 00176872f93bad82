#pragma once
/// A campaign of items: runs of one scenario with many sets of values, or diagnoses of many measurement sets. It is
/// carried out by one process or by many, at once or in several sessions, with the same results to the bit.
/// docs/campaigns.md.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bad_rows.h"
#include "export.h"
#include "progress.h"
#include "result.h"
#include "run.h"
#include "sweep.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// What a campaign of runs is made of.
struct RunCampaignInput {
  RunInput run;                       // its seed is the campaign's
  std::vector<SweepAxis> axes;        // of a grid: every value with every other
  std::vector<std::string> drawn;     // "key=uniform:LOW:HIGH" or "key=normal:MEAN:SD"
  std::vector<std::string> drawn_sd;  // "tire", "rig", "vehicle": every number with an _sd in that file is normal
  std::string list;                   // CSV file of a list: a column for each setting, a row for each item
  std::string design;                 // grid, list, monte_carlo, latin_hypercube, sobol, sobol_indices, morris; empty:
                                      // grid, list, or monte_carlo where something is drawn
  std::size_t points = 0;             // of a design that draws
};

/// The names that `design` may have.
std::vector<std::string> campaign_designs();

/// What a campaign of diagnoses is made of.
struct DiagnosisCampaignInput {
  std::vector<std::string> sets;     // their folders
  std::vector<std::string> only;     // as DiagnosisOptions has them
  std::vector<std::string> without;  // likewise
  double smallest_effect_percent = 0.5;
  BadRows bad_rows = BadRows::kRefuse;
};

/// Which items a process carries out: part `number` of `count`, from 1.
struct CampaignPart {
  std::size_t number = 1;
  std::size_t count = 1;
};

/// "3/10". Throws InputError.
CampaignPart read_campaign_part(const std::string& text);
/// What Slurm, Grid Engine, mpirun or srun says in the environment; none where the process was started by itself.
/// Throws InputError.
std::optional<CampaignPart> find_campaign_part();
/// As find_campaign_part(), but without job arrays, whose tasks may do different things.
std::optional<CampaignPart> find_launched_part();
/// Whether this process is a task of a job array.
bool is_array_task();

/// How far a campaign, or a part of it, is.
struct CampaignState : Report {
  std::size_t items = 0;
  std::size_t done = 0;  // with those that failed
  std::size_t failed = 0;
};

/// Makes the folder of a campaign with its campaign.json. Throws InputError: whatever is wrong with the runs or the
/// design, and where the folder holds files.
void define_run_campaign(const RunCampaignInput& input, const std::string& folder);
/// The same for diagnoses. A set that cannot be read becomes an item that fails; what is wrong with it is returned.
/// Throws InputError: no set can be read, an unknown effect, a smallest effect beyond 0 to 100 percent, and where the
/// folder holds files.
std::vector<std::string> define_diagnosis_campaign(const DiagnosisCampaignInput& input, const std::string& folder);

/// A campaign in its folder.
class ItemCampaign {
 public:
  /// Throws InputError: the folder holds no campaign.
  explicit ItemCampaign(const std::string& folder);

  /// Carries out what is not done of a part. Each result is saved as soon as it is there, so that an interruption
  /// loses only the items that are being computed. Throws InputError where another process works on the part, and where
  /// a file or the version of rollrig has changed since the campaign was begun; Interrupted.
  CampaignState carry_out(const CampaignPart& part, int threads = 0, const Progress& progress = {}) const;
  /// What all processes have done up to now.
  CampaignState read_state() const;
  /// Puts all results into one file, and removes the others. Throws InputError where a process still works, or merges
  /// them, too; no result is lost then.
  CampaignState merge() const;

  /// All items that are done, in their order: item, values, results, failure. The values of a diagnosis are the set and
  /// its folder. Throws InputError where none is done.
  void write_csv(const std::function<void(const std::string&)>& append) const;  // called with some rows at a time
  Export make_export() const;
  /// How much of a result's spread comes from which factor, for the designs sobol_indices and morris.
  /// Throws InputError: another design, an unknown result, too few items.
  Report calc_sensitivity(const std::string& result) const;
  /// Of diagnoses that are done: a report as that of diagnose_fleet(). Folders are absolute, and a set that failed has
  /// neither machine nor tire. Throws InputError where none is done, where a process writes results, and for runs.
  Report summarize_diagnoses() const;
  /// A job for Slurm's sbatch: an array of `tasks` tasks, each of which carries out a part. `program` is how the tasks
  /// call rollrig.
  std::string make_slurm_job(std::size_t tasks, const std::string& program) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace rollrig
#pragma GCC visibility pop
