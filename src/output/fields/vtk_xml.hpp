#pragma once
// VTK's XML files (.vtp, .vtu) with appended data, compressed block by block.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"
#include "output/fields/block_compressor.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// A text as the value of an attribute: with entities, and blanks for control characters and others than
/// ASCII.
std::string in_xml(const std::string& text);

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
  std::vector<VtkArray> facts{};  ///< more field data, of one tuple each
};

/// Turns data sets of one kind, one per state, into the bytes of files. VTK's own writer spends most of its
/// time on the ranges of values and on text, and compresses again what did not change since the last state.
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
  /// What is in the file; valid until the next call. Throws std::bad_alloc.
  File encode(VtkDataSet data);
  /// What of the states so far decides how the next ones are packed: after a restart files have the bytes
  /// that they would have had.
  void keep(Archive& archive);

 private:
  struct Memory {  // of an array in the state before
    std::string bytes;
    std::vector<std::string> blocks;           // compressed
    int states_to_store = 0;                   // that many are not worth the time of zlib
    std::vector<std::int64_t> before_restart;  // of each block, see mark_of; instead of bytes and blocks
  };
  bool pack_as_before(Memory& memory, std::size_t b, std::string_view block, int stride);
  void add_array(const char* section, VtkArray array, const char* attributes);
  void add_data(Memory& memory, std::string bytes, int stride);
  void put(std::string_view bytes);  ///< into the file's data: as they are, or as base64
  std::size_t block_bytes() const { return compression_.method == Compression::Method::xz ? 1 << 18 : 4096; }

  std::map<std::string, Memory> memory_;  // by section and name
  Compression compression_;
  std::unique_ptr<BlockCompressor> compressor_;
  bool as_text_ = false;
  std::string header_, data_;
};

}  // namespace courant
