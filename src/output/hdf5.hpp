#pragma once
// Small helpers around HDF5's C interface.
#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <utility>

namespace courant {

/// A guard around calls of HDF5, by one thread at a time. HDF5 crashes if an allocation fails, at once or
/// later. So the memory that it may need is tested before, and after a fault HDF5 is not called again. HDF5
/// prints nothing meanwhile.
class Hdf5Use {
 public:
  /// `bytes`: of written or read data, packed or not. Throws OutputError if they are not available, or HDF5
  /// failed before.
  Hdf5Use(const std::filesystem::path& file, std::size_t bytes);
  Hdf5Use(const Hdf5Use&) = delete;
  Hdf5Use& operator=(const Hdf5Use&) = delete;
  ~Hdf5Use();

  /// Reserves from here on the least memory of each use, so that the run itself cannot allocate it. Throws
  /// std::bad_alloc.
  static void reserve();
  /// HDF5 reported a fault; its state is unknown.
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
