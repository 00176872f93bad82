#include <matio.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <memory>

#include "sim/core/error.h"
#include "tables/formats.h"

namespace rollrig::tables {
namespace {

InputError make_damaged(const std::string& path) {
  return InputError({"a damaged .mat file", path, 0, "", "", "a whole .mat file, as its program wrote it", ""});
}

/// The library reads on where something is wrong, and tells it to this function alone.
bool complained = false;
void note_complaint(int /*level*/, char* /*message*/) { complained = true; }

/// Throws InputError for a file that ends before its last variable does, or has other bytes after a variable.
void require_whole(const std::string& path) {
  constexpr std::uint64_t kHeader = 128;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  std::uint64_t at = kHeader;
  while (at < size) {
    std::array<std::uint32_t, 2> tag{};
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(tag.data()), sizeof tag);
    constexpr std::uint32_t kMatrix = 14;
    constexpr std::uint32_t kCompressed = 15;
    if (!in || (tag[0] != kMatrix && tag[0] != kCompressed)) throw make_damaged(path);
    at += sizeof tag + tag[1];
  }
  if (at != size) throw make_damaged(path);
}

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

std::size_t count_elements(const matvar_t& variable) {
  std::size_t count = 1;
  for (int i = 0; i < variable.rank; ++i) count *= variable.dims[i];
  return count;
}

bool is_matrix(const matvar_t& variable) { return variable.rank == 2 && variable.data != nullptr; }

template <class T>
std::vector<double> copy_numbers(const matvar_t& variable) {
  const T* data = static_cast<const T*>(variable.data);
  return std::vector<double>(data, data + count_elements(variable));
}

/// None where the variable holds no real numbers.
std::vector<double> read_numbers(const matvar_t& variable) {
  if (!is_matrix(variable) || variable.isComplex != 0) return {};
  if (variable.nbytes < count_elements(variable) * static_cast<std::size_t>(std::max(variable.data_size, 1))) return {};
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return copy_numbers<double>(variable);
    case MAT_C_SINGLE:
      return copy_numbers<float>(variable);
    case MAT_C_INT8:
      return copy_numbers<mat_int8_t>(variable);
    case MAT_C_UINT8:
      return copy_numbers<mat_uint8_t>(variable);
    case MAT_C_INT16:
      return copy_numbers<mat_int16_t>(variable);
    case MAT_C_UINT16:
      return copy_numbers<mat_uint16_t>(variable);
    case MAT_C_INT32:
      return copy_numbers<mat_int32_t>(variable);
    case MAT_C_UINT32:
      return copy_numbers<mat_uint32_t>(variable);
    case MAT_C_INT64:
      return copy_numbers<mat_int64_t>(variable);
    case MAT_C_UINT64:
      return copy_numbers<mat_uint64_t>(variable);
    default:
      return {};
  }
}

void append_utf8(unsigned code, std::string& text) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

/// A text a row of a matrix of characters, without the blanks that fill it up.
std::vector<std::string> read_texts(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || !is_matrix(variable)) return {};
  const std::size_t rows = variable.dims[0];
  const std::size_t width = variable.dims[1];
  const bool is_wide = variable.data_type == MAT_T_UINT16 || variable.data_type == MAT_T_UTF16;
  if (variable.nbytes < rows * width * (is_wide ? 2 : 1)) return {};
  std::vector<std::string> texts(rows);
  for (std::size_t i = 0; i < rows * width; ++i) {
    std::string& text = texts[i % rows];
    if (is_wide) {
      append_utf8(static_cast<const mat_uint16_t*>(variable.data)[i], text);
    } else {
      text += static_cast<const char*>(variable.data)[i];
    }
  }
  for (std::string& text : texts) text.erase(text.find_last_not_of(' ') + 1);
  return texts;
}

std::vector<std::string> list_fields(const matvar_t& variable) {
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  const unsigned count = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  return names == nullptr ? std::vector<std::string>() : std::vector<std::string>(names, names + count);
}

class MatCollector {
 public:
  void add(const std::string& name, const std::string& group, const matvar_t& variable) {
    if (variable.class_type == MAT_C_STRUCT && variable.data != nullptr) {
      count_elements(variable) == 1 ? add_struct(name + ".", variable) : add_records(name + ".", variable);
    } else if (variable.class_type == MAT_C_CELL && variable.data != nullptr) {
      add_cell(name, group, variable);
    } else if (variable.class_type == MAT_C_CHAR) {
      const std::vector<std::string> texts = read_texts(variable);
      if (texts.size() > 1) columns_.push_back({name, group, texts});
    } else if (variable.class_type == MAT_C_OPAQUE || variable.class_type == MAT_C_OBJECT) {
      objects_.push_back(name);
    } else if (is_matrix(variable)) {
      add_matrix(name, group, variable.dims[0], variable.dims[1], read_numbers(variable), columns_);
    }
  }

  Columns take() { return std::move(columns_); }
  const std::vector<std::string>& objects() const { return objects_; }

 private:
  void add_struct(const std::string& group, const matvar_t& variable) {
    auto** fields = static_cast<matvar_t**>(variable.data);
    const std::vector<std::string> names = list_fields(variable);
    const std::size_t first = columns_.size();
    const matvar_t* units = nullptr;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (fields[i] == nullptr) continue;
      if (names[i] == "units" && fields[i]->class_type == MAT_C_STRUCT && count_elements(*fields[i]) == 1)
        units = fields[i];
      add(group + names[i], group, *fields[i]);
    }
    if (units != nullptr && units->data != nullptr) set_units(group, *units, first);
  }

  /// A field "units" of a struct, itself a struct of texts, has the units of the other fields.
  void set_units(const std::string& group, const matvar_t& units, std::size_t first) {
    auto** fields = static_cast<matvar_t**>(units.data);
    const std::vector<std::string> names = list_fields(units);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (fields[i] == nullptr) continue;
      const std::vector<std::string> texts = read_texts(*fields[i]);
      for (std::size_t k = first; k < columns_.size() && texts.size() == 1; ++k) {
        if (columns_[k].name == group + names[i]) columns_[k].unit = texts.front();
      }
    }
  }

  /// A struct array: every field that is one number, or one text, in all of its elements is a column.
  void add_records(const std::string& group, const matvar_t& variable) {
    auto** fields = static_cast<matvar_t**>(variable.data);
    const std::vector<std::string> names = list_fields(variable);
    const std::size_t count = count_elements(variable);
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<double> numbers;
      std::vector<std::string> texts;
      for (std::size_t row = 0; row < count; ++row) {
        const matvar_t* field = fields[row * names.size() + i];
        if (field == nullptr) continue;
        const std::vector<double> number = read_numbers(*field);
        const std::vector<std::string> text = read_texts(*field);
        if (number.size() == 1) numbers.push_back(number.front());
        if (text.size() == 1) texts.push_back(text.front());
      }
      if (numbers.size() == count && count > 1) columns_.push_back({group + names[i], group, numbers});
      if (texts.size() == count && count > 1) columns_.push_back({group + names[i], group, texts});
    }
  }

  void add_cell(const std::string& name, const std::string& group, const matvar_t& variable) {
    auto** cells = static_cast<matvar_t**>(variable.data);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count_elements(variable); ++i) {
      if (cells[i] == nullptr) return;
      const std::vector<std::string> text = read_texts(*cells[i]);
      if (text.size() > 1 || cells[i]->class_type != MAT_C_CHAR) return;
      texts.push_back(text.empty() ? "" : text.front());
    }
    if (texts.size() > 1) columns_.push_back({name, group, texts});
  }

  Columns columns_;
  std::vector<std::string> objects_;
};

}  // namespace

Columns read_mat(const std::string& path) {
  require_whole(path);
  Mat_LogInitFunc("rollrig", &note_complaint);
  using File = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!file) throw make_damaged(path);
  MatCollector collector;
  while (true) {
    const Variable variable(Mat_VarReadNext(file.get()), Mat_VarFree);
    if (!variable) break;
    if (variable->name != nullptr) collector.add(variable->name, "", *variable);
  }
  if (complained) throw make_damaged(path);
  Columns columns = collector.take();
  if (columns.empty() && !collector.objects().empty()) {
    throw InputError(
        {fmt::format("'{}' is an object of MATLAB, which other programs cannot read", collector.objects().front()),
         path, 0, "", "", "vectors, or a struct of vectors: table2struct(T, 'ToScalar', true) makes one of a table",
         ""});
  }
  return columns;
}

}  // namespace rollrig::tables
