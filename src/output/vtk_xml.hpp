#pragma once
// VTK's XML files (.vtp, .vtu) with appended raw data, compressed block by block.
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"
#include "output/block_compressor.hpp"

namespace courant {

/// One array of a file.
struct VtkArray {
  std::string name;
  const char* type = "Float32";  ///< VTK's word for the type of a value
  int components = 1;
  std::string dimension;  ///< in M, L, T; becomes VTK's UNITS_LABEL; empty: none
  std::string bytes;      ///< the values in the machine's byte order; shape: (tuples, components)
  bool operator==(const VtkArray& other) const { return name == other.name && bytes == other.bytes; }
};

/// A group of arrays, as VTK names it: PointData, CellData, Points, Verts, Cells.
struct VtkSection {
  const char* name;
  std::vector<VtkArray> arrays;
  bool operator==(const VtkSection& other) const { return arrays == other.arrays; }
};

/// A file with a single piece.
struct VtkDataSet {
  const char* type = "PolyData";  ///< or "UnstructuredGrid"
  std::string sizes;              ///< attributes of the piece: NumberOfPoints="3" ...
  Real t = 0;                     ///< goes into the field data `TimeValue` [T]
  std::vector<VtkSection> sections;
};

/// Turns data sets of one kind, one per state, into the bytes of files. VTK's own writer spends most of its
/// time on the ranges of values and on text, and compresses anew what did not change since the last state.
/// Here a block (4 KiB) with the same bytes as in the state before is taken from there, and an array whose
/// values zlib can hardly shrink (those of a moving liquid) is stored as it is for some states before the
/// next attempt. The bytes depend only on the data sets so far.
class VtkEncoder {
 public:
  explicit VtkEncoder(Compression compression = {});  ///< Throws std::bad_alloc.
  ~VtkEncoder();
  struct File {
    std::string_view header, data;  ///< its bytes, one part after the other
  };
  /// What stands in the file; valid until the next call. Throws std::bad_alloc.
  File encode(VtkDataSet data);

 private:
  struct Memory {  // of an array in the state before
    std::string bytes;
    std::vector<std::string> blocks;  // compressed
    int states_to_store = 0;          // that many are not worth the time of zlib
  };
  void add_array(const char* section, VtkArray array, const char* attributes);
  void add_data(Memory& memory, std::string bytes, int stride);
  std::size_t block_bytes() const { return compression_.method == Compression::Method::xz ? 1 << 18 : 4096; }

  std::map<std::string, Memory> memory_;  // by section and name
  Compression compression_;
  std::unique_ptr<BlockCompressor> compressor_;
  std::string header_, data_;
};

}  // namespace courant
