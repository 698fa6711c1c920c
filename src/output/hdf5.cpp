#include "output/hdf5.hpp"

#include <sys/mman.h>

#include <new>

#include "output/file.hpp"

namespace courant {
namespace {

constexpr std::size_t least = std::size_t{24} << 20;  // the library, its caches, zlib, blocks that grow

void* kept = MAP_FAILED;  // `least` bytes of addresses
bool broken = false;

void* take(std::size_t bytes) {
  return ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

void keep() {
  if (kept == MAP_FAILED) kept = take(least);
}

void give() {
  if (kept != MAP_FAILED) ::munmap(std::exchange(kept, MAP_FAILED), least);
}

}  // namespace

Hdf5Use::Hdf5Use(const std::filesystem::path& file, std::size_t bytes) {
  if (broken) throw OutputError(file, "HDF5 failed before");
  give();
  const std::size_t needed = least + bytes;
  void* const there = take(needed);
  if (there == MAP_FAILED) {
    keep();
    throw OutputError(file, "no memory for HDF5 beside the run");
  }
  ::munmap(there, needed);
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Use::~Hdf5Use() {
  if (!broken) H5Eset_auto2(H5E_DEFAULT, function_, data_);
  keep();
}

void Hdf5Use::reserve() {
  try {
    const Hdf5Use first("", 0);
    H5open();  // while there is memory
  } catch (const OutputError&) {
    throw std::bad_alloc();
  }
}

void Hdf5Use::failed() {
  broken = true;
}

bool Hdf5Use::works() {
  return !broken;
}

}  // namespace courant
