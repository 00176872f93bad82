#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "sim/core/error.h"
#include "tables/formats.h"
#include "tables/hdf5_handle.h"

namespace rollrig::tables {
namespace {

using Handle = Hdf5Handle;

/// The library prints nothing while one of these is there.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The texts that `read` fills in, of a type of the file.
template <class Read>
std::vector<std::string> read_strings(hid_t type, std::size_t count, const Read& read) {
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    require_hdf5(H5Tset_size(memory, H5T_VARIABLE));
    require_hdf5(H5Tset_cset(memory, H5Tget_cset(type)));
    std::vector<char*> cells(count, nullptr);
    require_hdf5(read(memory, cells.data()));
    for (char* cell : cells) {
      texts.emplace_back(cell == nullptr ? "" : cell);
      H5free_memory(cell);
    }
    return texts;
  }
  const std::size_t width = H5Tget_size(type);
  if (width == 0 || width > 65536) throw Hdf5Refused();
  std::string cells(width * count, '\0');
  require_hdf5(read(type, cells.data()));
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = cells.substr(i * width, width);
    text.erase(std::min(text.find('\0'), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    texts.push_back(text);
  }
  return texts;
}

/// A text that is an attribute; empty where there is none.
std::string read_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
  const auto read = [&](hid_t memory, void* out) { return H5Aread(attribute, memory, out); };
  return read_strings(type, 1, read).front();
}

std::string read_unit(hid_t object) {
  for (const char* name : {"unit", "units", "Unit", "Units"}) {
    const std::string unit = read_attribute(object, name);
    if (!unit.empty()) return unit;
  }
  return "";
}

bool is_number(H5T_class_t of) { return of == H5T_INTEGER || of == H5T_FLOAT; }

class Hdf5Collector {
 public:
  Hdf5Collector(std::string path, bool is_matlab) : path_(std::move(path)), separator_(is_matlab ? "." : "/") {}

  /// All that is in a group whose name, with its separator, is `prefix`.
  void visit(hid_t group, const std::string& prefix, int depth = 0) {
    constexpr int kDeepest = 30;
    H5O_info_t info;
    require_hdf5(H5Oget_info(group, &info));
    if (depth > kDeepest || !visited_.insert(info.addr).second) return;
    H5G_info_t links;
    require_hdf5(H5Gget_info(group, &links));
    for (hsize_t i = 0; i < links.nlinks; ++i) visit_link(group, prefix, i, depth);
  }

  Columns take() { return std::move(columns_); }

 private:
  void visit_link(hid_t group, const std::string& prefix, hsize_t index, int depth) {
    const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, index, nullptr, 0, H5P_DEFAULT);
    if (length < 0 || length > 65536) throw Hdf5Refused();
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, index, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    H5L_info_t link;
    require_hdf5(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT));
    if (link.type != H5L_TYPE_HARD || name.front() == '#') return;  // '#': what MATLAB refers to
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    const H5I_type_t type = H5Iget_type(object);
    if (type == H5I_DATASET) read_set(object, prefix, name);
    if (type != H5I_GROUP) return;
    const bool is_octave = H5Lexists(object, "type", H5P_DEFAULT) > 0 && H5Lexists(object, "value", H5P_DEFAULT) > 0;
    is_octave ? visit_octave(object, prefix, name, depth) : visit(object, prefix + name + separator_, depth + 1);
  }

  /// Octave puts every variable in a group with its type and its value.
  void visit_octave(hid_t group, const std::string& prefix, const std::string& name, int depth) {
    const Handle of(H5Oopen(group, "type", H5P_DEFAULT), H5Oclose);
    const std::string type = H5Iget_type(of) == H5I_DATASET ? read_text(of) : "";
    if (type.find("string") != std::string::npos || type == "cell") return;
    const Handle value(H5Oopen(group, "value", H5P_DEFAULT), H5Oclose);
    if (H5Iget_type(value) == H5I_DATASET) read_set(value, prefix, name);
    if (H5Iget_type(value) == H5I_GROUP) visit(value, prefix + name + separator_, depth + 1);
  }

  /// A data set that is one text.
  static std::string read_text(hid_t set) {
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
    const auto read = [&](hid_t memory, void* out) { return H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out); };
    return read_strings(type, 1, read).front();
  }

  void read_set(hid_t set, const std::string& prefix, const std::string& name) {
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2 || H5Sget_simple_extent_type(space) != H5S_SIMPLE) return;
    hsize_t extent[2] = {1, 1};
    H5Sget_simple_extent_dims(space, extent, nullptr);
    for (const hsize_t one : extent) require_table_size(one * sizeof(double), path_);
    const auto rows = static_cast<std::size_t>(extent[0]);
    const auto count = static_cast<std::size_t>(extent[0] * extent[1]);
    bytes_ += count * sizeof(double);
    require_table_size(bytes_, path_);
    if (count < 2) return;
    const H5T_class_t of = H5Tget_class(type);
    const std::size_t first = columns_.size();
    if (is_number(of) && read_attribute(set, "MATLAB_class") != "char") {
      std::vector<double> values(count);
      require_hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      add_matrix(prefix + name, prefix, static_cast<std::size_t>(extent[1]), rows, values, columns_);
    } else if (of == H5T_STRING && count == std::max(extent[0], extent[1])) {
      const auto read = [&](hid_t memory, void* out) {
        return H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
      };
      columns_.push_back({prefix + name, prefix, read_strings(type, count, read)});
    } else if (of == H5T_COMPOUND && rank == 1) {
      read_records(set, type, prefix + name + separator_, rows);
    }
    const std::string unit = columns_.size() > first ? read_unit(set) : "";
    for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].unit = unit;
  }

  /// A data set of records: its members are columns.
  void read_records(hid_t set, hid_t type, const std::string& group, std::size_t rows) {
    for (unsigned i = 0; i < static_cast<unsigned>(std::max(0, H5Tget_nmembers(type))); ++i) {
      char* const member = H5Tget_member_name(type, i);
      const std::string name = member == nullptr ? "" : member;
      H5free_memory(member);
      const Handle of(H5Tget_member_type(type, i), H5Tclose);
      if (name.empty() || !is_number(H5Tget_class(of))) continue;
      const Handle one(H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
      require_hdf5(H5Tinsert(one, name.c_str(), 0, H5T_NATIVE_DOUBLE));
      std::vector<double> values(rows);
      require_hdf5(H5Dread(set, one, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      columns_.push_back({group + name, group, values});
    }
  }

  std::string path_;
  std::string separator_;
  std::uintmax_t bytes_ = 0;  // of all values, which fill values may make far more than the file has
  Columns columns_;
  std::set<haddr_t> visited_;
};

bool is_of_matlab(const std::string& path) {
  std::string start(10, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == "MATLAB 7.3";
}

}  // namespace

Columns read_hdf5(const std::string& path) {
  const Silence silence;
  try {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    const Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose);
    Hdf5Collector collector(path, is_of_matlab(path));
    collector.visit(root, "");
    return collector.take();
  } catch (const Hdf5Refused&) {
    throw InputError({"a damaged HDF5 file, or one with a compression that is not read", path, 0, "", "",
                      "a whole file, not compressed or with gzip", ""});
  }
}

}  // namespace rollrig::tables
