#pragma once
/// What a comparison consists of, before it becomes text, JSON and a page.

#include <string>
#include <vector>

#include "include/rollrig/compare.h"

namespace rollrig::comparison {

/// A quantity over time, in the unit of its heading.
struct OverlayLine {
  std::vector<double> time_s;
  std::vector<double> values;  // NaN: a gap
};

struct OverlayPanel {
  std::string channel;             // "drum_torque_Nm"
  std::vector<OverlayLine> lines;  // one for each of the compared
};

/// A phase on the time axis of an overlay.
struct OverlayPhase {
  std::string name;
  double start_s = 0.0;
  double end_s = 0.0;
};

/// Channels that all of the compared have, over a common time.
struct Overlay {
  std::string title;  // of a set, the run
  std::vector<OverlayPhase> phases;
  std::vector<OverlayPanel> panels;
  double view_start_s = 0.0;  // before it nothing rolls
};

struct Compared {
  Comparison comparison;  // all but its text, JSON and functions
  std::vector<Overlay> overlays;
  std::optional<std::size_t> main;  // the value of the message
};

/// The difference of two values, without an interval.
Difference subtract(const std::optional<double>& value, const std::optional<double>& reference,
                    const std::string& unit);
/// A result in words: "RRc at 25 degC, 2 m drum", "sections city 1: rr energy" of "sections.city_1.rr_energy_Wh".
std::string label_result(const std::string& key);

/// An input in words: "Tire, geometry: outer diameter, m" of "tire.geometry.outer_diameter_m".
std::string label_input(const std::string& key);
/// A place in words: "Whole ISO 28580 test" of the test "iso_28580"; runs and phases as they are.
std::string label_place(const std::string& place);

/// Adds the interval of 95 % about the difference.
void add_interval(double sd, double coverage_factor, Difference& difference);
/// Says of a difference that has a value why it has no interval.
void add_reason(const std::string& why, Difference& difference);

/// "-0.738" and "-0.795 to -0.680": both with the decimals that give the largest of the three numbers three digits. "-"
/// where there is no value or no interval.
std::string show_difference(const Difference& difference);
std::string show_interval(const Difference& difference);

/// Whether an interval does not contain 0; true where there is no interval.
bool shows_difference(const Difference& difference);

/// Makes a value the main one, with a sentence on it for each but the reference: "RRc of b is 0.62 N/kN lower than that
/// of a (-7.1 %; 95 % interval -0.9 to -0.3 N/kN)".
void choose_main(std::size_t value, Compared& compared);

}  // namespace rollrig::comparison
