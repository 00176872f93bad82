// Which column of a log is which column of the set.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/math/constants/constants.hpp>

#include "measurements/logs/guess.h"
#include "sim/core/error.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

/// A word of headings. A whole word is one between blanks and signs, or the whole name; another may be part of a word.
struct NameWord {
  const char* text;
  int weight;
  bool is_whole = false;
};

/// Words in English and German, the more telling ones with more weight.
const QuantityMap<std::vector<NameWord>>& name_words() {
  static const QuantityMap<std::vector<NameWord>> all{
      {quantities::kSpeed,
       {{"geschwindigkeit", 10},
        {"speed", 10},
        {"velocity", 10},
        {"tempo", 8, true},
        {"trommeldrehzahl", 9},
        {"drumrpm", 9},
        {"vel", 4, true},
        {"v", 2, true}}},
      {quantities::kLoad,
       {{"radlast", 10},
        {"aufstandskraft", 10},
        {"normalkraft", 10},
        {"wheelload", 10},
        {"normalforce", 10},
        {"verticalforce", 10},
        {"vertikalkraft", 10},
        {"tireload", 10},
        {"load", 8, true},
        {"last", 8, true},
        {"fz", 8, true},
        {"fn", 4, true}}},
      {quantities::kAmbient,
       {{"umgebung", 10},
        {"ambient", 10},
        {"raumtemp", 10},
        {"roomtemp", 10},
        {"lufttemp", 10},
        {"airtemp", 10},
        {"hallentemp", 10},
        {"raum", 6, true},
        {"halle", 6, true},
        {"room", 6, true},
        {"air", 6, true},
        {"luft", 6, true},
        {"amb", 6, true},
        {"umg", 6, true}}},
      {quantities::kDrumTorque,
       {{"drehmoment", 10},
        {"torque", 10},
        {"antriebsmoment", 10},
        {"moment", 8, true},
        {"trommelmoment", 10},
        {"md", 4, true},
        {"trq", 4, true},
        {"m", 2, true}}},
      {quantities::kLinerTemperature,
       {{"liner", 10},
        {"innentemp", 10},
        {"reifentemp", 8},
        {"tiretemp", 8},
        {"tyretemp", 8},
        {"innen", 6, true},
        {"inner", 6, true},
        {"reifen", 4, true},
        {"tire", 4, true},
        {"tyre", 4, true}}},
      {quantities::kCavityPressure,
       {{"reifendruck", 10},
        {"tirepressure", 10},
        {"tyrepressure", 10},
        {"inflation", 9},
        {"fuelldruck", 10},
        {"innendruck", 10},
        {"cavitypressure", 10},
        {"druck", 6},
        {"pressure", 6},
        {"p", 2, true}}},
      {quantities::kGasTemperature, {{"gastemp", 12}, {"fuellgas", 12}, {"cavitytemp", 12}, {"gas", 8, true}}},
      {quantities::kSurfaceTemperature,
       {{"trommeltemp", 10},
        {"oberflaechentemp", 10},
        {"drumtemp", 10},
        {"surfacetemp", 10},
        {"drumsurface", 9},
        {"rollertemp", 10},
        {"surface", 5, true},
        {"oberflaeche", 5, true}}},
      {rigs::find_machine_kind("flat_belt").traits.force,
       {{"beltforce", 10}, {"bandkraft", 10}, {"antriebskraft", 8}, {"driveforce", 8}, {"fx", 4, true}}},
      {quantities::kLongitudinalForce, {{"longitudinal", 10}, {"laengskraft", 10}, {"fx", 6, true}}},
      {quantities::kLossForce, {{"loss", 10}, {"verlust", 10}}},
      {quantities::kElevation, {{"elevation", 10}, {"altitude", 10}, {"hoehe", 10}, {"height", 10}, {"alt", 4, true}}},
      {quantities::kTractionForce,
       {{"traction", 10}, {"tractive", 10}, {"zugkraft", 10}, {"antriebskraft", 10}, {"driveforce", 8}}},
  };
  return all;
}

/// Headings with these words are not what was measured.
constexpr const char* kUnwanted[] = {"soll",       "setpoint", "target",  "demand", "windspeed",
                                     "windgeschw", "slip",     "schlupf", "stddev"};

/// Lower case, umlauts written out, other signs as blanks.
std::string plain_words(const std::string& name) {
  std::string text = name;
  for (const auto& [umlaut, letters] : {std::pair<const char*, const char*>{"\u00E4", "ae"},
                                        {"\u00F6", "oe"},
                                        {"\u00FC", "ue"},
                                        {"\u00C4", "ae"},
                                        {"\u00D6", "oe"},
                                        {"\u00DC", "ue"},
                                        {"\u00DF", "ss"}}) {
    boost::algorithm::replace_all(text, umlaut, letters);
  }
  boost::algorithm::to_lower(text);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9'); }, ' ');
  return text;
}

/// How well a name goes with a quantity; 0: not at all.
int score_name(const std::string& name, const Quantity& quantity) {
  const auto known = name_words().find(quantity);
  if (known == name_words().end()) return 0;
  const std::string plain = plain_words(name);
  std::vector<std::string> words;
  boost::algorithm::split(
      words, plain, [](char c) { return c == ' '; }, boost::algorithm::token_compress_on);
  const std::string joined = boost::algorithm::replace_all_copy(plain, " ", "");
  for (const char* unwanted : kUnwanted) {
    if (joined.find(unwanted) != std::string::npos) return 0;
  }
  words.push_back(joined);
  int best = 0;
  for (const NameWord& word : known->second) {
    const bool is_there = word.is_whole ? std::find(words.begin(), words.end(), word.text) != words.end()
                                        : joined.find(word.text) != std::string::npos;
    if (is_there) best = std::max(best, word.weight);
  }
  return best;
}

constexpr int kExact = 100;  // the heading is that of the set's column

int score_heading(const std::string& heading, const HeadingParts& parts, const Quantity& quantity) {
  if (heading == quantity.header()) return kExact;
  if (parts.unit.has_value() && !parts.unit->is_of(quantity)) return 0;
  return score_name(parts.name, quantity);
}

/// Pairs of headings and quantities, found best first.
class ColumnMatcher {
 public:
  ColumnMatcher(const GuessSource& source, const GuessedTime& time) : source_(source) {
    for (const rigs::Column& column : source.kind->columns.all()) {
      const std::string header = column.quantity.header();
      if (source.options.columns.count(header) == 0 && source.options.values.count(header) == 0) {
        open_.push_back(column.quantity);
      }
    }
    for (const std::string& heading : source.form.headings) {
      if (heading != time.heading && heading != time.date_heading) free_.push_back(heading);
    }
  }

  void take(const Quantity quantity, std::string heading, const std::string& reason) {
    free_.erase(std::remove(free_.begin(), free_.end(), heading), free_.end());
    open_.erase(std::remove(open_.begin(), open_.end(), quantity), open_.end());
    found_[quantity] = {std::move(heading), reason};
  }

  /// Takes the pair with the highest score until none has one.
  void match_names() {
    for (;;) {
      int best = 0;
      std::vector<std::pair<Quantity, std::string>> pairs;
      for (const Quantity& quantity : open_) {
        for (const std::string& heading : free_) {
          const int score = score_heading(heading, source_.parts_of(heading), quantity);
          if (score > best) pairs.clear();
          best = std::max(best, score);
          if (score > 0 && score == best) pairs.emplace_back(quantity, heading);
        }
      }
      if (pairs.empty()) return;
      require_single(pairs);
      take(pairs.front().first, pairs.front().second, best == kExact ? "the heading of a set" : "the name");
    }
  }

  /// A quantity without a column, and one column alone in a unit of it that nothing else would take.
  void match_units() {
    const std::vector<Quantity> open = open_;
    for (const Quantity& quantity : open) {
      if (!is_needed(quantity)) continue;  // few have it
      const auto goes = [&](const std::string& heading) {
        const HeadingParts& parts = source_.parts_of(heading);
        return parts.unit.has_value() && !parts.unit->is_rpm() && parts.unit->is_of(quantity);
      };
      const auto rivals = std::count_if(open.begin(), open.end(), [&](const Quantity& other) {
        return other.file_unit().dimension == quantity.file_unit().dimension && is_needed(other);
      });
      if (rivals != 1 || std::count_if(free_.begin(), free_.end(), goes) != 1) continue;
      take(quantity, *std::find_if(free_.begin(), free_.end(), goes), "the only other column in such a unit");
    }
  }

  const QuantityMap<std::pair<std::string, std::string>>& found() const { return found_; }

 private:
  static bool is_needed(const Quantity& quantity) {
    const Quantity rare[] = {quantities::kHungTorque,     quantities::kHungForce,   quantities::kSurfaceTemperature,
                             quantities::kGasTemperature, quantities::kContactLoad, quantities::kSpeedReading};
    return std::find(std::begin(rare), std::end(rare), quantity) == std::end(rare);
  }

  void require_single(const std::vector<std::pair<Quantity, std::string>>& pairs) const {
    for (std::size_t i = 1; i < pairs.size(); ++i) {
      if (pairs[i].first != pairs.front().first) continue;
      const std::string header = pairs.front().first.header();
      throw source_.problem(fmt::format("'{}' and '{}' may both be {}", pairs.front().second, pairs[i].second, header),
                            "--column", pairs[i].second,
                            fmt::format("--column \"{}={}\", or the other", header, pairs.front().second));
    }
  }

  const GuessSource& source_;
  std::vector<Quantity> open_;
  std::vector<std::string> free_;
  QuantityMap<std::pair<std::string, std::string>> found_;  // heading and reason
};

void take_named(const GuessSource& source, ColumnMatcher& matcher) {
  for (const auto& [header, heading] : source.options.columns) {
    if (header == "time") continue;
    const std::vector<std::string>& known = source.form.headings;
    if (std::find(known.begin(), known.end(), heading) == known.end()) {
      InputProblem problem = unknown_name("heading", heading, known);
      problem.file = source.logs.front().path;
      problem.line = source.form.csv.header_line;
      problem.key = "--column";
      throw InputError(problem);
    }
    matcher.take(intern_quantity(header), heading, "as --column says");
  }
}

GuessedUnit find_column_unit(const GuessSource& source, const Quantity& target, const std::string& heading,
                             const std::vector<double>& numbers, std::string& reason) {
  const auto given = source.options.units.find(target.header());
  const HeadingParts& parts = source.parts_of(heading);
  std::optional<GuessedUnit> unit = parts.unit;
  if (given != source.options.units.end()) {
    unit = find_unit(given->second);
    if (!unit.has_value() || !unit->is_of(target)) {
      throw source.problem(fmt::format("'{}' is no unit of {} that rollrig knows", given->second, target.header()),
                           "--unit", given->second, fmt::format("such as {}", target.file_unit().symbol));
    }
    reason += "; unit as --unit says";
  } else if (heading == target.header()) {
    unit = GuessedUnit{std::string(target.unit_suffix()), 1.0, 0.0, target.file_unit().symbol};
  } else if (unit.has_value()) {
    reason += fmt::format("; the log states {}", unit->written);
  } else if (!parts.unknown_unit.empty()) {
    throw source.problem(
        fmt::format("'{}' is no unit that rollrig knows, over the column for {}", parts.unknown_unit, target.header()),
        "--unit", parts.unknown_unit, fmt::format("--unit {}=UNIT", target.header()));
  } else {
    return guess_unit_by_size(source, target, heading, numbers, reason);
  }
  if (unit->is_rpm()) {
    if (source.drum_diameter_m <= 0.0) {
      throw source.problem("revolutions per minute need a drum", "--unit", heading,
                           fmt::format("--unit {}=UNIT", target.header()));
    }
    reason += fmt::format(" of the drum of {:.4g} m", source.drum_diameter_m);
    return {"m_s", boost::math::constants::pi<double>() * source.drum_diameter_m / 60.0, 0.0, unit->written};
  }
  if (!unit->is_of(target)) {
    throw source.problem(fmt::format("{} is no unit of {}", unit->written, target.header()), "--column", heading,
                         "a column in a unit of this quantity");
  }
  return *unit;
}

/// Finds whether the log counts the other way: loads and driving torques are positive in sets.
void find_sign(const GuessSource& source, const std::vector<double>& numbers, GuessedColumn& column) {
  if (column.target != quantities::kLoad && column.target != source.kind->traits.force) return;
  if (is_of_vehicle(source.kind->traits)) return;
  std::vector<double> large;
  double largest = 0.0;
  for (const double number : numbers) largest = std::isnan(number) ? largest : std::max(largest, std::abs(number));
  const double share = column.target == quantities::kLoad ? 0.5 : 0.1;
  for (const double number : numbers) {
    if (std::abs(number) > share * largest) large.push_back(number);
  }
  const auto negative = std::count_if(large.begin(), large.end(), [](double number) { return number < 0.0; });
  if (10 * negative < 9 * static_cast<std::ptrdiff_t>(large.size())) return;
  column.sign = -1.0;
  column.reason += "; nearly all are negative: the sign is turned";
}

/// A reading a little below zero, of a load or a speed.
void find_dead_band(const std::vector<double>& numbers, GuessedColumn& column) {
  constexpr double kLittle = 0.02;  // Assumed: of the largest value
  if (column.target != quantities::kLoad && column.target != quantities::kSpeed) return;
  double lowest = 0.0, highest = 0.0;
  for (const double number : numbers) {
    if (std::isnan(number)) continue;
    const double value = column.unit.convert(column.sign * number, column.target);
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  if (lowest >= 0.0 || -lowest > kLittle * highest) return;
  column.dead_band = std::ceil(-12.0 * lowest) / 10.0;  // a little more
  column.reason += fmt::format("; down to {:.3g} {} at rest: taken as 0", lowest, column.target.file_unit().symbol);
}

void add_constants(const GuessSource& source, std::vector<GuessedColumn>& columns) {
  for (const auto& [header, value] : source.options.values) {
    const Quantity target = intern_quantity(header);
    columns.push_back({target, "", {}, 1.0, 0.0, value, "a constant, as --value says"});
  }
}

/// What a set cannot do without.
void require_needed(const GuessSource& source, const std::vector<GuessedColumn>& columns) {
  const auto has = [&columns](const Quantity& target) {
    return std::any_of(columns.begin(), columns.end(),
                       [&target](const GuessedColumn& column) { return column.target == target; });
  };
  std::vector<Quantity> needed{source.kind->traits.force};
  for (const rigs::Column& column : source.kind->columns.given) needed.push_back(column.quantity);
  for (const Quantity& quantity : needed) {
    if (has(quantity)) continue;
    const std::string header = quantity.header();
    const bool may_be_constant = quantity != source.kind->traits.force;
    throw source.problem(
        fmt::format("no column of the logs is told to be {}", header), "--column",
        fmt::format("{}", fmt::join(source.form.headings, ", ")),
        fmt::format("--column \"{}=HEADING\"{}", header,
                    may_be_constant ? fmt::format(", or --value {}=NUMBER of what was not logged", header) : ""));
  }
}

}  // namespace

std::vector<GuessedColumn> guess_columns(const GuessSource& source, const GuessedTime& time) {
  ColumnMatcher matcher(source, time);
  take_named(source, matcher);
  matcher.match_names();
  matcher.match_units();
  std::vector<GuessedColumn> columns;
  for (const rigs::Column& of_set : source.kind->columns.all()) {
    const auto at = matcher.found().find(of_set.quantity);
    if (at == matcher.found().end()) continue;
    const auto& [heading, reason] = at->second;
    const std::vector<double> numbers = source.numbers_of(heading);
    GuessedColumn column{of_set.quantity, heading, {}, 1.0, 0.0, std::nullopt, reason};
    column.unit = find_column_unit(source, of_set.quantity, heading, numbers, column.reason);
    find_sign(source, numbers, column);
    find_dead_band(numbers, column);
    columns.push_back(std::move(column));
  }
  add_constants(source, columns);
  require_needed(source, columns);
  return columns;
}

}  // namespace rollrig::measurements
