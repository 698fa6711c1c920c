#pragma once
// Small helpers around HDF5's C interface.
#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <utility>

namespace courant {

/// Around calls of HDF5, of one thread at a time. HDF5 crashes where it gets no memory, at once or later on,
/// so what it may need is looked for before, and after a fault of HDF5 it is not called any more. It prints
/// nothing meanwhile.
class Hdf5Use {
 public:
  /// `bytes`: of what is written or read, packed or not. Throws OutputError where they are not to be had, or
  /// HDF5 failed before.
  Hdf5Use(const std::filesystem::path& file, std::size_t bytes);
  Hdf5Use(const Hdf5Use&) = delete;
  Hdf5Use& operator=(const Hdf5Use&) = delete;
  ~Hdf5Use();

  /// Keeps from here on what each use needs at least, so that the run itself cannot take it. Throws
  /// std::bad_alloc.
  static void reserve();
  /// HDF5 reported a fault; what state it is in is not known.
  static void failed();
  static bool works();

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns an HDF5 identifier and closes it with the function of its kind.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0 && Hdf5Use::works()) close_(id_);
  }
  operator hid_t() const { return id_; }
  herr_t close() {
    const hid_t id = std::exchange(id_, -1);
    return close_(id);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace courant
