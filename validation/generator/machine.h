#pragma once
/// What a case was measured on: drum, dynamometer or road. A machine that lacks one of these parts does not compile.

#include <string>
#include <vector>

#include "validation/generator/campaign.h"
#include "validation/generator/recorder.h"
#include "validation/generator/sensors.h"

namespace rollrig::generator {

/// A column of what the machine was told, or reports.
struct GivenColumn {
  const char* name;
  std::vector<double> RunRecord::*values;
  const char* format;
};

class Machine {
 public:
  virtual ~Machine() = default;

  virtual const char* name() const = 0;  // as files have it
  virtual Grounds grounds() const = 0;   // all that it has
  /// Whether the force of the whole vehicle is measured, and not that of one wheel.
  virtual bool has_vehicle() const = 0;
  /// Whether the speed has a knot each second, so that the integration goes in steps of its own.
  virtual bool has_knots() const = 0;

  virtual const std::vector<GivenColumn>& given_columns() const = 0;
  virtual const std::vector<Channel>& channels() const = 0;  // measured; the first is the force
  /// Whether the files of a set on this machine give the number, with an uncertainty.
  virtual bool gives(const Specimen& specimen, Base which) const = 0;
  virtual std::string write_set_keys(const Specimen& specimen) const = 0;
  virtual std::string file_name() const = 0;  // of its own file
  virtual std::string write_file(const Specimen& specimen) const = 0;

  /// Draws what of the specimen is this machine's.
  virtual void draw_own(std::uint64_t seed, Specimen& specimen) const = 0;
  virtual Campaign draw_campaign(const CampaignOrder& order, const Specimen& specimen) const = 0;

  /// Loss on its surface over that on the drum to which the tire's law refers.
  virtual double calc_curvature_factor(const Specimen& specimen) const = 0;
  /// Of the first channel, in its unit over N at the surface.
  virtual double find_lever(const Specimen& specimen) const = 0;
  /// Inertia that the measured force has in it, as a mass at the surface. The load is on its way to `target_load_N`.
  virtual double calc_moving_mass_kg(const Specimen& specimen, double load_N, double target_load_N) const = 0;
};

const std::vector<const Machine*>& all_machines();
/// Throws InputError where there is none of that name.
const Machine& find_machine(const std::string& name);

}  // namespace rollrig::generator
