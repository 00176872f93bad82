#pragma once
/// An identifier of HDF5 that closes itself.

#include <hdf5.h>

#include <stdexcept>

namespace rollrig::tables {

/// The library refused: a file to be read is damaged, or holds something that the library was not built for.
struct Hdf5Refused : std::runtime_error {
  Hdf5Refused() : std::runtime_error("HDF5 refused") {}
};

template <class Result>
Result require_hdf5(Result result) {
  if (result < 0) throw Hdf5Refused();
  return result;
}

class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(require_hdf5(id)), close_(close) {}
  ~Hdf5Handle() { close_(id_); }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace rollrig::tables
