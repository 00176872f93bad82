#pragma once
/// assets/tires/<name>.toml: reading, with every rule of formats.md, and writing.

#include <map>
#include <optional>
#include <string>

#include "models/tire/conversion_laws.h"
#include "models/tire/correlation.h"
#include "models/tire/tire.h"
#include "models/tire/tire_class.h"

namespace rollrig::models {

constexpr const char* kTireFormat = "rollrig-tire";
constexpr int kTireFormatVersion = 2;

/// Conductances as identified on one rig ([thermal.rig.<name>]); what is absent there is that of [thermal], or of the
/// rig's cooling.
struct RigThermal {
  std::optional<double> rest_conductance_W_per_K;
  std::optional<double> rest_conductance_sd_W_per_K;
  std::optional<double> speed_conductance_W_s_per_m_K;
  std::optional<double> speed_conductance_sd_W_s_per_m_K;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"conductance_at_rest_W_per_K", non_negative(), "", {}, "z_W_per_K"}, p.rest_conductance_W_per_K);
    visit(Field{"conductance_at_rest_W_per_K_sd", positive(), "", {}, "z_W_per_K_sd"}, p.rest_conductance_sd_W_per_K);
    visit(Field{"conductance_per_speed_W_s_per_m_K", non_negative(), "", {}, "f_W_s_per_m_K"},
          p.speed_conductance_W_s_per_m_K);
    visit(Field{"conductance_per_speed_W_s_per_m_K_sd", positive(), "", {}, "f_W_s_per_m_K_sd"},
          p.speed_conductance_sd_W_s_per_m_K);
  }
};

/// Heat that a rig's air and surface take from a tire, per area of its outside ([tire_cooling] of a rig).
/// Equation  z = k A, f = k_v A,  A = pi/2 (D^2 - d^2) + pi D W
/// Symbols   z, f conductances of the tire at rest [W/K] and per speed [W s/(m K)]; k, k_v those per area; A two
///           sidewalls and the tread [m2]; D, d outer and rim diameter, W section width [m]
/// Source    Assumed: all of the outside gives heat alike
struct TireCooling {
  double at_rest_W_per_m2_K = 0.0;
  double per_speed_W_s_per_m3_K = 0.0;

  bool is_given() const { return at_rest_W_per_m2_K > 0.0 || per_speed_W_s_per_m3_K > 0.0; }

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"at_rest_W_per_m2_K", non_negative(), "k, heat transfer from the outside of a tire"},
          p.at_rest_W_per_m2_K);
    visit(Field{"per_speed_W_s_per_m3_K", non_negative(), "k_v, its rise with speed"}, p.per_speed_W_s_per_m3_K);
  }
};

/// A of TireCooling [m2].
double calc_outer_area_m2(const TireGeometry<double>& geometry);

/// The rig on which a tire runs, as far as its heat is concerned.
struct CoolingRig {
  std::string name;          // by which a tire may have conductances of its own there
  TireCooling cooling{};     // of tires that have none
  TireCooling cooling_sd{};  // standard uncertainties, 0 where the rig's file gives none
};

/// [iso_28580]: what the tire's label or a test says, for comparison and as default test conditions. With
/// [service_description], all but the RRc has a default by class (find_iso_test()).
struct Iso28580Reference {
  double rrc = 0.0;  // N/N
  double load_N = 0.0;
  double pressure_Pa = 0.0;
  double warm_up_s = 0.0;                  // of the class
  double ambient_coefficient_per_K = 0.0;  // K_t of the class
  double speed_m_s = 0.0;
  double soak_s = 3.0 * 3600.0;  // of the class; no key of the file

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"rrc_N_per_kN", between(0.01, 500.0), ""}, p.rrc);
    visit(Field{"load_N", between(1.0, 1000000.0), ""}, p.load_N);
    visit(Field{"pressure_kPa", between(1.0, 10000.0), ""}, p.pressure_Pa);
    visit(Field{"warm_up_min", between(1.0, 600.0), "", 30.0}, p.warm_up_s);
    visit(Field{"ambient_coefficient_per_degC", between(0.0, 0.05), "", kAmbientCoefficient_per_K},
          p.ambient_coefficient_per_K);
    visit(Field{"speed_km_h", between(5.0, 250.0), "", 80.0}, p.speed_m_s);
  }
};

/// [validity]: the range for which a tire file may be used, measured or assumed. A run beyond it is warned of.
struct TireValidity {
  double highest_speed_m_s = 0.0;
  double lowest_load_N = 0.0;
  double highest_load_N = 0.0;
  double lowest_K = 0.0;  // of the liner
  double highest_K = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"highest_speed_km_h", positive(), ""}, p.highest_speed_m_s);
    visit(Field{"lowest_load_N", non_negative(), ""}, p.lowest_load_N);
    visit(Field{"highest_load_N", positive(), ""}, p.highest_load_N);
    visit(Field{"lowest_temperature_degC", any_number(), ""}, p.lowest_K);
    visit(Field{"highest_temperature_degC", any_number(), ""}, p.highest_K);
  }
};

/// Which law gives the loss before any effect acts (`baseline` of runs and sets).
enum class Baseline {
  kCombined,    // that of the tire file's model
  kConstantRrc  // a constant coefficient
};

/// What the numbers of a tire file without a standard uncertainty are from (`basis`).
enum class TireBasis {
  kUnknown,   // the file does not say
  kMeasured,  // identified from measurements of this tire
  kClass      // values of the tire's class, or guesses
};

struct TireFile {
  std::string path;
  std::string content;  // as read, for the manifest's hash
  std::string name;
  std::string designation;
  TireParameters<double> values;
  TireParameters<double> standard_uncertainties;  // 0 where none was given
  TireBasis basis = TireBasis::kUnknown;
  TireCorrelation correlation;  // of numbers with one; may be empty
  bool has_stiffness = false;
  bool has_rolling_resistance = false;
  bool has_thermal = false;
  bool has_constant = false;
  std::map<std::string, RigThermal> rig_thermal;
  std::optional<ServiceDescription> service;
  std::optional<Iso28580Reference> iso_28580;
  std::optional<TireValidity> validity;
  std::vector<double> sweep_loads_N;  // [load_sweep] loads_N: the loads of its load sweep; may be empty

  /// The model of the tire against a baseline.
  const TireModel& model(Baseline baseline) const;

  /// The parameters as they hold on a rig. Each conductance is that of [thermal.rig.<name>]; else both are those of
  /// [thermal], or, where there are none, by the rig's cooling. Throws InputError when a table is absent that the model
  /// needs, or there are no conductances.
  TireParameters<double> parameters_on(const CoolingRig& rig, Baseline baseline) const;
  /// Standard uncertainties of the numbers that hold on a rig; 0 where no file gives one. A conductance of
  /// [thermal.rig.<name>] has its own, or without one that of [thermal]; one by the rig's cooling has that of the
  /// cooling, times the outer area.
  TireParameters<double> standard_uncertainties_on(const CoolingRig& rig) const;
  /// Whether the file gives a standard uncertainty of any number of the heat balance ([thermal], of any rig), or else
  /// of the loss (all other tables).
  bool gives_uncertainty_of(bool heat_balance) const;
  /// A sentence for each number of the file that is not what the class of [service_description] asks for: load,
  /// pressure, speed, warm-up and K_t of [iso_28580]; class C1 above load index 121, or with a designation of
  /// commercial vehicles ("C" at its end, "LT" before it); class C3 with a pressure of cars, which is one in psi; an RRc
  /// that the class does not have. Empty without [service_description].
  std::vector<std::string> list_class_doubts() const;
  /// A warning where this tire names the rigs on which its conductances hold, and this rig is none of them.
  std::optional<std::string> warn_of_conductances(const CoolingRig& rig) const;

  /// The parameters against a constant coefficient, which needs [constant] alone. Tables that are absent take values of
  /// passenger-car tires, for effects that want them: heat capacity 1640 J/(kg K) of the tire's mass, gas 95 J/K,
  /// H 4 W/K, conductance 12 W/K at rest and 1.4 W s/(m K) per speed, 220 kN/m, slip stiffness 75 kN, pressure exponent
  /// 0.4, the load and the pressure given as references. Throws InputError without [constant].
  /// Source    Assumed: those of the asset tires
  /// Checked   tests/models/tire_file_test.cpp
  TireParameters<double> parameters_with_class_values(double load_N, double pressure_Pa) const;
};

/// Reads a tire from parsed TOML. Throws InputError.
TireFile read_tire(const ConfigTable& config);

/// The file as TOML. `notes` holds a comment for dotted keys ("rolling_resistance.A0_N").
std::string write_tire(const TireFile& tire, const std::map<std::string, std::string>& notes = {});

}  // namespace rollrig::models
