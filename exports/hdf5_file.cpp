// HDF5: groups, data sets and the attribute "unit".
#include <fmt/format.h>

#include <algorithm>

#include "exports/tree.h"
#include "sim/core/interrupt.h"
#include "sim/core/units.h"
#include "tables/hdf5_handle.h"

namespace rollrig::exports {
namespace {

// The file lies in memory, so that only a fault of this program makes the library refuse.
using Handle = tables::Hdf5Handle;
using tables::require_hdf5;

/// Strings of one length, padded with NUL.
Handle make_text_type(std::size_t length) {
  const hid_t type = require_hdf5(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

/// As h5py writes a bool.
Handle make_flag_type() {
  const hid_t type = require_hdf5(H5Tenum_create(H5T_STD_I8LE));
  const signed char no = 0;
  const signed char yes = 1;
  require_hdf5(H5Tenum_insert(type, "FALSE", &no));
  require_hdf5(H5Tenum_insert(type, "TRUE", &yes));
  return {type, H5Tclose};
}

Handle make_scalar() { return {H5Screate(H5S_SCALAR), H5Sclose}; }
Handle make_space(std::size_t size) {
  const hsize_t extent = size;
  return {H5Screate_simple(1, &extent, nullptr), H5Sclose};
}

/// No times, so that the same tree gives the same bytes; long data deflated.
Handle make_data_properties(hid_t space) {
  constexpr hsize_t kDeflatedFrom = 512;
  constexpr hsize_t kChunk = 8192;
  constexpr unsigned kLevel = 6;
  const hid_t properties = require_hdf5(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, 0);
  const auto size = static_cast<hsize_t>(H5Sget_simple_extent_npoints(space));
  if (size >= kDeflatedFrom) {
    const hsize_t chunk = std::min(size, kChunk);
    H5Pset_chunk(properties, 1, &chunk);
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, kLevel);
  }
  return {properties, H5Pclose};
}

Handle make_data(hid_t place, const std::string& link, hid_t type, hid_t space) {
  const Handle properties = make_data_properties(space);
  return {H5Dcreate2(place, link.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose};
}

void write_data(hid_t place, const std::string& link, hid_t type, hid_t space, const void* data) {
  require_hdf5(H5Dwrite(make_data(place, link, type, space), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
}

void write_numbers(hid_t place, const std::string& link, const std::string& key, hid_t space, const double* values) {
  const Handle set = make_data(place, link, H5T_IEEE_F64LE, space);
  require_hdf5(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  const std::string unit = unit_of_key(key).symbol;
  if (unit.empty()) return;
  const Handle type = make_text_type(unit.size());
  const Handle attribute(H5Acreate2(set, "unit", type, make_scalar(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require_hdf5(H5Awrite(attribute, type, unit.data()));
}

/// HDF5 takes a slash for a path, and a name of C ends at a zero.
std::string make_link(const std::string& name) {
  std::string link = name.empty() || name == "." ? "_" : name;
  const auto is_refused = [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; };
  std::replace_if(link.begin(), link.end(), is_refused, '_');
  return link;
}

void write_members(hid_t place, const Group& group);

/// Writes a value named `key` as `link` into the group `place`.
struct ValueWriter {
  hid_t place;
  const std::string& link;
  const std::string& key;

  void operator()(double value) const { write_numbers(place, link, key, make_scalar(), &value); }
  void operator()(const Column& column) const {
    write_numbers(place, link, key, make_space(column.size()), column.data());
  }
  void operator()(bool flag) const {
    const signed char value = flag ? 1 : 0;
    write_data(place, link, make_flag_type(), make_scalar(), &value);
  }
  void operator()(const std::string& text) const {
    write_data(place, link, make_text_type(text.size()), make_scalar(), text.c_str());
  }
  void operator()(const Texts& texts) const {
    std::size_t length = 1;
    for (const std::string& text : texts) length = std::max(length, text.size());
    std::string cells(length * texts.size(), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&cells[i * length], length);
    write_data(place, link, make_text_type(length), make_space(texts.size()), cells.data());
  }
  void operator()(const Group& group) const {
    const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    const Handle made(H5Gcreate2(place, link.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
    write_members(made, group);
  }
  void operator()(const List& list) const {
    const std::size_t width = fmt::formatted_size("{}", list.items.size());
    Group group;
    for (const Node& item : list.items) group.add(fmt::format("{:0{}}", group.members.size(), width), item);
    (*this)(group);
  }
};

void write_members(hid_t place, const Group& group) {
  std::set<std::string> taken;
  for (const auto& [key, node] : group.members) {
    throw_if_interrupted();
    const std::string link = take_name(make_link(key), taken);
    std::visit(ValueWriter{place, link, key}, node.value);
  }
}

std::string copy_image(hid_t file) {
  require_hdf5(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const ssize_t size = require_hdf5(H5Fget_file_image(file, nullptr, 0));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  require_hdf5(H5Fget_file_image(file, bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace

std::string make_hdf5(const Group& tree) {
  constexpr std::size_t kGrowth = 1U << 20U;  // bytes
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  require_hdf5(H5Pset_fapl_core(access, kGrowth, 0));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  const Handle file(H5Fcreate("in memory", H5F_ACC_TRUNC, creation, access), H5Fclose);
  write_members(file, tree);
  return copy_image(file);
}

}  // namespace rollrig::exports
