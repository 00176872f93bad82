#pragma once
/// Settings of a scenario: declared by a visit() as parameters are, read from [settings], shown by describe.

#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <boost/algorithm/string/join.hpp>

#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// A path in a file, relative to that file's folder; on the command line relative to the working folder.
struct FilePath {
  std::string path;  // as it is opened
};
void read_member(TableReader& reader, const Field& field, FilePath& member);

/// A name that a file or another setting gives meaning to; empty where none is given. Read under the old key as well.
struct Name {
  std::string value;
};
void read_member(TableReader& reader, const Field& field, Name& member);

namespace detail {

inline Json to_json(const Field&, const Name& member) { return member.value; }
inline Json to_json(const Field& field, double member) { return unit_of_key(field.key).from_si(member); }
inline Json to_json(const Field&, int member) { return member; }
inline Json to_json(const Field& field, const std::optional<double>& member) {
  return member.has_value() ? Json(unit_of_key(field.key).from_si(*member)) : Json();
}
inline Json to_json(const Field&, const Choice& member) { return member.value; }
inline Json to_json(const Field&, const FilePath& member) { return member.path; }

template <class Member>
void add_hash(const Field&, const Member&, Json&) {}
void add_hash(const Field& field, const FilePath& member, Json& hashes);

inline Json to_json(const Field& field, const std::vector<double>& member) {
  Json list = Json::array();
  for (const double item : member) list.push_back(unit_of_key(field.key).from_si(item));
  return list;
}

/// A default that a member has without a fallback of its field; "see text" where it is empty.
std::string show_default(const Json& value);

template <class Member>
std::string show_default(const Field& field, const Member& member) {
  if (field.fallback.has_value()) return fmt::format("{:.6g}", *field.fallback);
  const bool is_required = std::is_arithmetic_v<Member> || std::is_same_v<Member, FilePath>;
  return is_required ? "required" : show_default(to_json(field, member));
}

template <class Member>
std::string show_range(const Field& field, const Member&) {
  return field.range.to_string();
}
inline std::string show_range(const Field&, const FilePath&) { return "path"; }
inline std::string show_range(const Field&, const Name&) { return "name"; }
inline std::string show_range(const Field&, const Choice& member) {
  return boost::algorithm::join(member.allowed, " or ");
}

template <class Member>
SettingInfo make_setting_info(const Field& field, const Member& member) {
  SettingInfo info{field.key, show_range(field, member), show_default(field, member), field.doc};
  if constexpr (std::is_arithmetic_v<Member> || std::is_same_v<Member, std::optional<double>>) {
    info.limits = field.range;
  } else if constexpr (std::is_same_v<Member, Choice>) {
    info.choices = member.allowed;
  }
  return info;
}

}  // namespace detail

template <class Settings>
std::vector<SettingInfo> list_settings() {
  std::vector<SettingInfo> list;
  Settings settings;
  Settings::visit(settings, [&list](const Field& field, auto& member) {
    list.push_back(detail::make_setting_info(field, member));
  });
  return list;
}

/// Reads a scenario's settings; every key must be known.
template <class Settings>
Settings read_settings(const RunSpec& spec) {
  Settings settings;
  TableReader reader(spec.settings, "[settings]");
  read_fields(reader, settings);
  reader.finish();
  return settings;
}

/// What is wrong with a setting: with its file, line and value where it was given, for the caller to throw.
InputProblem setting_problem(const RunSpec& spec, const char* key, const std::string& what, const std::string& allowed);

/// Every setting as used, in the units of the keys, then `<key>_sha256` of the files that some name: for the manifest.
template <class Settings>
Json settings_to_json(const Settings& settings) {
  Json json = Json::object();
  Json hashes = Json::object();
  Settings::visit(settings, [&](const Field& field, const auto& member) {
    json[field.key] = detail::to_json(field, member);
    detail::add_hash(field, member, hashes);
  });
  json.update(hashes);
  return json;
}

}  // namespace rollrig::scenarios
