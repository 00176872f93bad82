#pragma once
/// Declared once, used everywhere: a field's key, unit, range, default and meaning drive the reading of
/// files, the messages about them, the manifest and the reference pages.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/config.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig {

/// Allowed values of a number, in the unit of the file.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  bool contains(double value) const;
  /// For messages, such as "> 0 and <= 1".
  std::string to_string() const;
};

constexpr Range any_number() { return {}; }
constexpr Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
constexpr Range non_negative() { return {0.0, std::numeric_limits<double>::infinity(), false, false}; }
/// Numbers of tires, rigs and vehicles are held within limits far beyond all that is built, so that a unit mistaken by
/// a thousand is refused, and no simulation runs on without end. Assumed: these limits.
constexpr Range between(double lower, double upper) { return {lower, upper, false, false}; }

/// Declaration of one number of a file. The unit is read off the key's suffix.
struct Field {
  const char* key;
  Range range;
  const char* doc;
  std::optional<double> fallback = std::nullopt;  // in the file's unit; absent = the key is required
  const char* old_key = nullptr;                  // of an earlier format; it is read as well

  /// The name of the number in JSON output, which keeps that of the first format.
  const char* output_key() const { return old_key != nullptr ? old_key : key; }
};

/// Reads one table, key by key, and then refuses what nobody asked for.
class TableReader {
 public:
  /// `name` is how the table is called in messages, such as "[thermal]"; empty for the top level.
  TableReader(const ConfigTable& table, std::string name);

  bool has(const std::string& key) const;
  /// A number in SI units, checked against its range. Throws InputError.
  double number(const Field& field);
  /// A number in SI units where present; `<key>_sd` is read with number_or_none({"x_sd", positive(), ""}). Of the key
  /// and its old one, that holds which a run gives beside the file.
  std::optional<double> number_or_none(const Field& field);
  /// A list of numbers in SI units, at least one; `fallback` (in SI units) where absent.
  std::vector<double> numbers_or(const Field& field, const std::vector<double>& fallback);
  /// A whole number.
  int count(const Field& field);
  /// A string; with `choices` not empty it must be one of them.
  std::string text(const std::string& key, const std::vector<std::string>& choices = {});
  std::string text_or(const std::string& key, const std::string& fallback,
                      const std::vector<std::string>& choices = {});
  bool flag_or(const std::string& key, bool fallback);
  /// A subtable, or nullptr where absent.
  const ConfigTable* table(const std::string& key);
  /// An array of tables ([[key]]); empty where absent.
  std::vector<const ConfigTable*> tables(const std::string& key);
  /// Throws InputError for the first key that was never asked for.
  void finish() const;

  /// Names `key` as known although it is read elsewhere or not at all.
  void accept(const std::string& key) { known_.push_back(key); }
  /// An InputProblem that stands at this table, for the caller to complete.
  InputError problem(const std::string& key, const std::string& what, const std::string& allowed = {}) const;
  const std::string& name() const { return name_; }
  const ConfigTable& source() const { return table_; }

 private:
  const ConfigValue* find(const std::string& key);
  const ConfigValue& require(const std::string& key);
  double convert(const Field& field, const ConfigValue& value) const;
  std::string full_key(const std::string& key) const;

  const ConfigTable& table_;
  std::string name_;
  std::vector<std::string> known_;
};

/// Checks the `format` key: present, of the wanted kind and of a version from 1 to the newest that this program reads.
void check_format(TableReader& reader, const std::string& kind, int newest_version);

/// A text of a file that is one of a few.
struct Choice {
  std::string value;
  std::vector<std::string> allowed;
};

/// Reads one declared member: a number, an optional number, a whole number or a list of numbers. What is
/// absent keeps the field's fallback; a list or an optional keeps the member's value.
inline void read_member(TableReader& reader, const Field& field, double& member) { member = reader.number(field); }
inline void read_member(TableReader& reader, const Field& field, std::optional<double>& member) {
  const std::optional<double> given = reader.number_or_none(field);
  if (given.has_value()) member = given;
}
inline void read_member(TableReader& reader, const Field& field, int& member) { member = reader.count(field); }
inline void read_member(TableReader& reader, const Field& field, Choice& member) {
  member.value = reader.text_or(field.key, member.value, member.allowed);
}
inline void read_member(TableReader& reader, const Field& field, std::vector<double>& member) {
  member = reader.numbers_or(field, member);
}

/// Reads every field that P::visit declares, in SI units.
template <class P>
void read_fields(TableReader& reader, P& parameters) {
  P::visit(parameters, [&reader](const Field& field, auto& member) { read_member(reader, field, member); });
}

/// Reads the standard uncertainty `<key>_sd` beside every field that P::visit declares; 0 where absent.
template <class P>
void read_standard_uncertainties(TableReader& reader, P& uncertainties) {
  P::visit(uncertainties, [&reader](const Field& field, auto& member) {
    const std::string key = std::string(field.key) + "_sd";
    const std::string old_key = std::string(field.output_key()) + "_sd";
    member = reader.number_or_none({key.c_str(), positive(), "", std::nullopt, old_key.c_str()}).value_or(0.0);
  });
}

/// Every field that P::visit declares, for reference pages and messages.
template <class P>
std::vector<Field> list_fields() {
  std::vector<Field> fields;
  P parameters{};
  P::visit(parameters, [&fields](const Field& field, auto&) { fields.push_back(field); });
  return fields;
}

}  // namespace rollrig
