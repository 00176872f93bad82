// MATLAB's .mat, version 5.
#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <boost/locale/encoding_utf.hpp>
#include <boost/scope_exit.hpp>
#include <memory>
#include <stdexcept>

#include "exports/tree.h"
#include "sim/core/error.h"
#include "sim/core/interrupt.h"
#include "sim/core/units.h"

namespace rollrig::exports {
namespace {

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

constexpr const char* kUnits = "units";

Variable require_mat(matvar_t* variable) {
  if (variable == nullptr) throw std::runtime_error("matio refused a variable");
  return {variable, Mat_VarFree};
}

struct Type {
  matio_classes in_matlab;
  matio_types in_file;
};
constexpr Type kDouble{MAT_C_DOUBLE, MAT_T_DOUBLE};

/// A variable of `extents` rows and columns, which are copied. Its name is where it is put.
Variable make_variable(Type type, std::array<std::size_t, 2> extents, const void* data, int options = 0) {
  return require_mat(
      Mat_VarCreate(nullptr, type.in_matlab, type.in_file, 2, extents.data(), const_cast<void*>(data), options));
}

Variable make_text(const std::string& text) {
  const std::u16string wide = boost::locale::conv::utf_to_utf<char16_t>(text);
  return make_variable({MAT_C_CHAR, MAT_T_UTF16}, {wide.empty() ? 0U : 1U, wide.size()}, wide.data());
}

/// A column of cells; takes what it holds.
Variable make_cell(std::vector<Variable> items) {
  std::vector<matvar_t*> pointers;
  pointers.reserve(items.size());
  for (Variable& item : items) pointers.push_back(item.release());
  return make_variable({MAT_C_CELL, MAT_T_CELL}, {pointers.size(), 1}, pointers.data());
}

/// A letter first, then letters, digits and '_', as many as MATLAB reads.
std::string make_identifier(const std::string& name) {
  constexpr std::size_t kLongest = 60;  // of 63, so that there is room for "_2"
  std::string identifier;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_allowed = is_letter || (c >= '0' && c <= '9') || c == '_';
    if (identifier.empty() && !is_letter) identifier = "x";
    identifier += is_allowed ? c : '_';
  }
  return identifier.empty() ? "x" : identifier.substr(0, kLongest);
}

using Fields = std::vector<std::pair<std::string, Variable>>;

/// A struct; takes what it holds.
Variable make_struct(Fields fields) {
  std::vector<const char*> names;
  for (const auto& field : fields) names.push_back(field.first.c_str());
  std::array<std::size_t, 2> extents{1, 1};
  Variable made =
      require_mat(Mat_VarCreateStruct(nullptr, 2, extents.data(), names.data(), static_cast<unsigned>(names.size())));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    Mat_VarSetStructFieldByIndex(made.get(), i, 0, fields[i].second.release());
  }
  return made;
}

Variable make_value(const Node& node);

Fields make_fields(const Group& group) {
  std::set<std::string> taken;
  if (group.is_table) taken.insert(kUnits);
  Fields fields;
  Fields units;
  for (const auto& [name, node] : group.members) {
    throw_if_interrupted();
    const std::string field = take_name(make_identifier(name), taken);
    const std::string unit = unit_of_key(name).symbol;
    if (!unit.empty()) units.emplace_back(field, make_text(unit));
    fields.emplace_back(field, make_value(node));
  }
  if (group.is_table) fields.emplace_back(kUnits, make_struct(std::move(units)));
  return fields;
}

struct ValueMaker {
  Variable operator()(double value) const { return make_variable(kDouble, {1, 1}, &value); }
  Variable operator()(const Column& column) const {
    return make_variable(kDouble, {column.size(), column.empty() ? 0U : 1U}, column.data());
  }
  Variable operator()(bool flag) const {
    const mat_uint8_t value = flag ? 1 : 0;
    return make_variable({MAT_C_UINT8, MAT_T_UINT8}, {1, 1}, &value, MAT_F_LOGICAL);
  }
  Variable operator()(const std::string& text) const { return make_text(text); }
  Variable operator()(const Texts& texts) const {
    std::vector<Variable> items;
    for (const std::string& text : texts) items.push_back(make_text(text));
    return make_cell(std::move(items));
  }
  Variable operator()(const Group& group) const { return make_struct(make_fields(group)); }
  Variable operator()(const List& list) const {
    std::vector<Variable> items;
    for (const Node& item : list.items) items.push_back(make_value(item));
    return make_cell(std::move(items));
  }
};

Variable make_value(const Node& node) { return std::visit(ValueMaker{}, node.value); }

void require_size(const std::string& name, matvar_t& variable) {
  constexpr std::size_t kLargest = 2'000'000'000;  // bytes; sizes are 32 bits, with sign in older readers
  const std::size_t size = Mat_VarGetSize(&variable);
  if (size < kLargest) return;
  throw InputError({fmt::format("'{}' has {} bytes, more than a .mat file holds", name, size), "", 0, "--mat", "",
                    "2 GB a variable; --hdf5 has no such limit", ""});
}

std::string read_all(int descriptor) {
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (n <= 0) throw std::runtime_error("a file in memory cannot be read");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

void write_variables(const std::string& path, const Group& tree) {
  using File = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
  constexpr const char* kHeader = "MATLAB 5.0 MAT-file, Created By: rollrig";  // without a date: same tree, same bytes
  const File file(Mat_CreateVer(path.c_str(), kHeader, MAT_FT_MAT5), Mat_Close);
  if (!file) throw std::runtime_error("matio refused to write");
  for (auto& [name, variable] : make_fields(tree)) {
    throw_if_interrupted();
    require_size(name, *variable);
    variable->name = ::strdup(name.c_str());  // NOLINT: freed with the variable
    if (Mat_VarWrite(file.get(), variable.get(), MAT_COMPRESSION_ZLIB) != 0) {
      throw std::runtime_error(fmt::format("matio refused to write '{}'", name));
    }
  }
}

}  // namespace

std::string make_mat(const Group& tree) {
  const int descriptor = ::memfd_create("rollrig.mat", MFD_CLOEXEC);  // the library writes files alone
  if (descriptor < 0) throw std::runtime_error("no file in memory can be made");
  BOOST_SCOPE_EXIT_ALL(&) { ::close(descriptor); };
  write_variables(fmt::format("/proc/self/fd/{}", descriptor), tree);
  return read_all(descriptor);
}

}  // namespace rollrig::exports
