#include "output/restart_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "base/version.hpp"
#include "output/file.hpp"
#include "output/hdf5.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view trailer_start = "\ncourant restart file, format ";
constexpr std::size_t trailer_bytes = 74, crc_bytes = 9;  // the CRC-32 in hex and the line end

std::string trailer_without_crc(int format, std::int64_t cycle) {
  return fmt::format("{}{:5d}, cycle {:14d}, crc32 ", trailer_start, format, cycle);
}

std::uint32_t crc_of(std::uint32_t crc, std::string_view bytes) {
  constexpr std::size_t most = 1u << 30;  // zlib counts in unsigned int
  for (std::size_t at = 0; at < bytes.size(); at += most) {
    const std::string_view piece = bytes.substr(at, most);
    crc = static_cast<std::uint32_t>(
        crc32(crc, reinterpret_cast<const Bytef*>(piece.data()), static_cast<uInt>(piece.size())));
  }
  return crc;
}

hid_t type_in_file(SavedType type) {
  switch (type) {
    case SavedType::real:
      return H5T_IEEE_F64LE;
    case SavedType::integer64:
      return H5T_STD_I64LE;
    case SavedType::integer32:
      return H5T_STD_I32LE;
    case SavedType::byte:
      break;
  }
  return H5T_STD_I8LE;
}

hid_t type_in_memory(SavedType type) {
  switch (type) {
    case SavedType::real:
      return H5T_NATIVE_DOUBLE;
    case SavedType::integer64:
      return H5T_NATIVE_INT64;
    case SavedType::integer32:
      return H5T_NATIVE_INT32;
    case SavedType::byte:
      break;
  }
  return H5T_NATIVE_INT8;
}

/// The file as HDF5 keeps it in memory: HDF5 never writes to the disk itself, because after a failed write
/// its clean-up at exit crashes.
class Image {
 public:
  explicit Image(std::string name)
      : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), name_(std::move(name) + ".in_memory") {
    constexpr std::size_t growth = 1 << 22;  // bytes
    H5Pset_fclose_degree(access_, H5F_CLOSE_STRONG);
    // H5Fget_file_image of HDF5 1.10 spoils the checksum that later formats have in their first block
    H5Pset_libver_bounds(access_, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
    H5Pset_fapl_core(access_, growth, false);
  }
  hid_t create() { return H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_); }
  hid_t open(std::string& bytes) {
    if (H5Pset_file_image(access_, bytes.data(), bytes.size()) < 0) return -1;
    return H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access_);
  }

 private:
  Hdf5Handle access_;
  std::string name_;
};

bool put(hid_t file, const std::string& path, const SavedArray& array) {
  const hsize_t columns = array.rows > 0 ? array.count() / array.rows : 0;
  const hsize_t size[] = {array.rows, columns};
  constexpr hsize_t longest_chunk = 1 << 16, worth_it = 256;  // numbers
  const hsize_t chunk[] = {1, std::min(columns, longest_chunk)};
  const int rank = array.rows == 1 ? 1 : 2, first = rank == 1 ? 1 : 0;
  Hdf5Handle space(H5Screate_simple(rank, size + first, nullptr), H5Sclose),
      options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  if (columns >= worth_it) {  // small ones take more space in pieces than as they are
    H5Pset_chunk(options, rank, chunk + first);
    H5Pset_shuffle(options);
    H5Pset_deflate(options, 1);
    H5Pset_fletcher32(options);
  }
  Hdf5Handle dataset(
      H5Dcreate2(file, path.c_str(), type_in_file(array.type), space, links, options, H5P_DEFAULT), H5Dclose);
  if (dataset < 0) return false;
  if (array.bytes.empty()) return true;
  return H5Dwrite(dataset, type_in_memory(array.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.bytes.data()) >=
             0 &&
         dataset.close() >= 0;
}

/// All of the state as the bytes of an HDF5 file. Throws OutputError.
std::string image_of(const fs::path& file, SavedState& state) {
  std::size_t size_of_state = 0;
  for (const auto& [path, array] : state) size_of_state += array.bytes.size();
  constexpr std::size_t of_dataset = 8192;
  const Hdf5Use use(file, 2 * size_of_state + state.size() * of_dataset);
  const auto stop = [&] {
    Hdf5Use::failed();
    throw OutputError(file, "no memory for a copy of the state in HDF5's form");
  };
  Image image(file.string());
  Hdf5Handle h5(image.create(), H5Fclose);
  if (h5 < 0) stop();
  for (auto& [path, array] : state) {
    if (!put(h5, path, array)) stop();
    Array<std::byte>().swap(array.bytes);  // it is in the image now
  }
  if (H5Fflush(h5, H5F_SCOPE_LOCAL) < 0) stop();
  const ssize_t size = H5Fget_file_image(h5, nullptr, 0);
  if (size <= 0) stop();
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(h5, bytes.data(), bytes.size()) < 0) stop();
  if (h5.close() < 0) stop();
  return bytes;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw RestartError(fmt::format("cannot restart from '{}': {}", file.string(), why));
}

struct Trailer {
  int format = 0;
  std::int64_t cycle = 0;
  std::uint32_t crc = 0;
};

std::string trailer_of(const Trailer& t) {
  return trailer_without_crc(t.format, t.cycle) + fmt::format("{:08x}\n", t.crc);
}

/// False where the text is not that of a trailer.
bool parse(std::string_view text, Trailer& to) {
  if (text.size() != trailer_bytes || text.substr(0, trailer_start.size()) != trailer_start) return false;
  const auto number = [&](std::size_t at, std::size_t width, auto& value, int base) {
    std::string_view word = text.substr(at, width);
    while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    return error == std::errc() && end == word.data() + word.size();
  };
  const std::size_t at = trailer_start.size();
  return number(at, 5, to.format, 10) && number(at + 13, 14, to.cycle, 10) &&
         number(trailer_bytes - crc_bytes, crc_bytes - 1, to.crc, 16) && text == trailer_of(to);
}

std::string whole_content(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) refuse(file, "it is a folder");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) refuse(file, "it is no file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, std::strerror(errno));
  const auto size = fs::file_size(file, error);
  if (error) refuse(file, error.message());
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(stream.gcount()) != bytes.size()) refuse(file, "it cannot be read to its end");
  return bytes;
}

/// Checks the last line and takes it off.
void check(const fs::path& file, std::string& bytes) {
  Trailer trailer;
  const bool is_hdf5 = bytes.rfind("\x89HDF\r\n", 0) == 0;
  if (bytes.size() < trailer_bytes ||
      !parse(std::string_view(bytes).substr(bytes.size() - trailer_bytes), trailer))
    refuse(file, is_hdf5 ? "the file is not whole: its last line is missing" : "it is no restart file");
  const std::uint32_t crc = crc_of(0, std::string_view(bytes).substr(0, bytes.size() - crc_bytes));
  if (crc != trailer.crc) refuse(file, "the file is damaged: its checksum is not that of its content");
  if (trailer.format != restart_format)
    refuse(file,
           fmt::format("it has format {}; this is courant {}, which reads format {}: use the version of "
                       "courant that wrote it",
                       trailer.format, COURANT_VERSION, restart_format));
  bytes.resize(bytes.size() - trailer_bytes);
}

/// False where the dataset is none of ours.
bool get(hid_t file, const std::string& path, SavedArray& to) {
  Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) return false;
  Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const std::size_t width = H5Tget_size(type);
  to.type = H5Tget_class(type) == H5T_FLOAT ? SavedType::real
            : width == 8                    ? SavedType::integer64
            : width == 4                    ? SavedType::integer32
                                            : SavedType::byte;
  hsize_t size[2] = {1, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != 1 && rank != 2) return false;
  if (H5Sget_simple_extent_dims(space, size, nullptr) < 0) return false;
  to.rows = rank == 2 ? size[0] : 1;
  // no more than the file can hold, compressed as far as deflate goes, before memory is asked for
  constexpr double most_compression = 1100, slack = 4096;
  const double bytes = static_cast<double>(size[0]) * static_cast<double>(size[1]) * to.width();
  if (bytes > most_compression * static_cast<double>(H5Dget_storage_size(dataset)) + slack) return false;
  to.bytes.resize(size[0] * size[1] * to.width());
  return to.bytes.empty() ||
         H5Dread(dataset, type_in_memory(to.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, to.bytes.data()) >= 0;
}

}  // namespace

void write_restart_file(const fs::path& file, SavedState& state, std::int64_t cycle) {
  const std::string bytes = image_of(file, state);
  const std::uint32_t crc = crc_of(crc_of(0, bytes), trailer_without_crc(restart_format, cycle));
  write_file(file, {bytes, trailer_of({restart_format, cycle, crc})}, Durable::yes);
}

SavedState read_restart_file(const fs::path& file) {
  std::string bytes = whole_content(file);
  check(file, bytes);
  const Hdf5Use use(file, 4 * bytes.size());
  Image image(file.string());
  const Hdf5Handle h5(image.open(bytes), H5Fclose);
  if (h5 < 0) refuse(file, "HDF5 cannot read it");
  std::string().swap(bytes);
  std::vector<std::string> paths;
  H5Ovisit(
      h5, H5_INDEX_NAME, H5_ITER_NATIVE,
      [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->emplace_back(name);
        return 0;
      },
      &paths);
  SavedState state;
  for (const std::string& path : paths)
    if (!get(h5, path, state[path])) refuse(file, "HDF5 cannot read '" + path + "' in it");
  return state;
}

std::vector<RestartFile> restart_files(const fs::path& folder) {
  struct DatedFile {
    RestartFile file;
    fs::file_time_type written;
  };
  std::vector<DatedFile> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code no_file;
    if (it->path().extension() != ".h5" || !it->is_regular_file(no_file)) continue;
    std::ifstream stream(it->path(), std::ios::binary);
    std::string text(trailer_bytes, '\0');
    stream.seekg(-static_cast<std::streamoff>(trailer_bytes), std::ios::end);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    Trailer trailer;
    std::error_code unknown;
    if (stream && parse(text, trailer))
      found.push_back({{it->path(), trailer.cycle}, fs::last_write_time(it->path(), unknown)});
  }
  std::sort(found.begin(), found.end(), [](const DatedFile& a, const DatedFile& b) {
    return a.file.cycle != b.file.cycle ? a.file.cycle > b.file.cycle : a.written > b.written;
  });
  std::vector<RestartFile> out;
  for (DatedFile& one : found) out.push_back(std::move(one.file));
  return out;
}

}  // namespace courant
