#pragma once
/// Keyword arguments, which become members of the API's structs under the same names.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <rollrig/error.h>

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.h"
#include "text.h"

namespace rollrig::python {

/// What messages say of a member that several numbers make up.
template <class Member>
struct Expected;
template <>
struct Expected<std::array<double, 3>> {
  static constexpr const char* kText = "three numbers are expected";
};
template <>
struct Expected<std::pair<double, double>> {
  static constexpr const char* kText = "two numbers are expected";
};
template <>
struct Expected<std::pair<std::array<double, 3>, std::array<double, 3>>> {
  static constexpr const char* kText = "two times three numbers are expected";
};

/// A bool of Python or NumPy.
bool is_bool(py::handle given);
/// Whether there is one among the elements of a list or an array, or among theirs.
bool has_bool(py::handle given, int levels = 2);

/// Each throws TypeError for a value of another type, and InputError for a number that the member cannot hold. Both
/// name the argument.
template <class Member, std::enable_if_t<!std::is_integral_v<Member>, int> = 0>
void read_argument(py::handle given, const std::string& name, Member& member) {
  try {
    if (has_bool(given)) throw wrong_type(name, Expected<Member>::kText, given);
    member = given.cast<Member>();
  } catch (const py::cast_error&) {
    throw wrong_type(name, Expected<Member>::kText, given);
  } catch (py::error_already_set& error) {  // as of an array without dimensions, which has no length
    if (!error.matches(PyExc_TypeError)) throw;
    throw wrong_type(name, Expected<Member>::kText, given);
  }
}
void read_argument(py::handle given, const std::string& name, bool& flag);
void read_argument(py::handle given, const std::string& name, double& number);
void read_argument(py::handle given, const std::string& name, std::string& text);
/// A text alone is a list of it.
void read_argument(py::handle given, const std::string& name, std::vector<std::string>& texts);

/// The whole number of an argument, of any size.
py::int_ to_whole_number(py::handle given, const std::string& name);
[[noreturn]] void refuse_size(py::handle given, const std::string& name, const std::string& allowed);

template <class Whole, std::enable_if_t<std::is_integral_v<Whole>, int> = 0>
void read_argument(py::handle given, const std::string& name, Whole& number) {
  const py::int_ whole = to_whole_number(given, name);
  constexpr Whole kLowest = std::numeric_limits<Whole>::min();
  constexpr Whole kHighest = std::numeric_limits<Whole>::max();
  if (whole < py::int_(kLowest)) refuse_size(given, name, std::to_string(kLowest) + " or more");
  if (whole > py::int_(kHighest)) refuse_size(given, name, std::to_string(kHighest) + " or less");
  number = whole.cast<Whole>();
}
template <class Member>
void read_argument(py::handle given, const std::string& name, std::optional<Member>& member) {
  read_argument(given, name, member.emplace());
}
template <class Value>
void read_argument(py::handle given, const std::string& name, std::map<std::string, Value>& values) {
  if (!py::isinstance<py::dict>(given)) throw wrong_type(name, "a dict is expected", given);
  values.clear();
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(given)) {
    const std::string of = to_string(key, name);
    read_argument(value, name + ": " + of, values[of]);
  }
}

/// The argument of that name.
template <class Member>
Member read_argument(py::handle given, const std::string& name) {
  Member member{};
  read_argument(given, name, member);
  return member;
}

/// Reads a dict whose absent keys leave a member as it is.
class Keywords {
 public:
  explicit Keywords(py::dict given) : given_(std::move(given)) {}
  /// Of a dict that is itself the argument `of`.
  Keywords(py::handle given, const std::string& of);

  template <class Member>
  Keywords& read(const char* name, Member& member) {
    known_.insert(name);
    if (given_.contains(name)) read_argument(given_[name], of_.empty() ? name : of_ + ": " + name, member);
    return *this;
  }
  /// Throws TypeError for a key that was not read.
  void require_all_read() const;

 private:
  py::dict given_;
  std::string of_;  // empty for keyword arguments
  std::set<std::string> known_;
};

}  // namespace rollrig::python
