#include "output/history.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "output/hdf5.hpp"
#include "output/history_checksum.hpp"

namespace courant {
namespace {

constexpr std::size_t chunk_rows = 1024;                     // what HDF5 packs at a time
constexpr std::size_t gauge_rows_of_chunk = 256;             // not packed: hundreds of datasets of few rows
constexpr std::size_t most_buffered = std::size_t{1} << 22;  // numbers, 32 MiB

/// Text of the innermost entry of HDF5's error stack, the one with the system's reason.
std::string innermost_error() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* client) -> herr_t {
        if (error->desc) *static_cast<std::string*>(client) = error->desc;
        return 1;  // the first one is enough
      },
      &text);
  // The system's reason is somewhere in HDF5's sentence; the plain reason is what users and our advice know.
  for (int number : {ENOSPC, EDQUOT, EFBIG, EACCES, EROFS, EPERM, EIO})
    if (text.find(std::strerror(number)) != std::string::npos) return std::strerror(number);
  return text.empty() ? "HDF5 failed" : "HDF5 failed: " + text;
}

constexpr std::string_view gauge_group = "/gauges/";

/// Of a dataset of a gauge, by its path without the first '/', its name; else empty.
std::string gauge_of(const std::string& path) {
  const std::string_view group = gauge_group.substr(1);
  if (!path.starts_with(group)) return "";
  return path.substr(group.size(), path.rfind('/') - group.size());
}

std::string content(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(error ? 0 : static_cast<std::size_t>(size), '\0');
  if (bytes.empty() || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) ||
      !take_history_checksum(bytes))
    throw OutputError(file, "what was written before cannot be read back");
  return bytes;
}

void write_checked(const std::filesystem::path& file, const std::string& bytes) {
  write_file(file, {bytes, history_checksum(bytes)});
}

/// The file as HDF5 keeps it in memory: HDF5 never writes to the disk itself, because after a failed write
/// (disk full) its clean-up at exit crashes.
class HistoryFile {
 public:
  /// `image`: bytes of the file so far, empty for a new one.
  HistoryFile(const std::filesystem::path& name, const std::string& image)
      : name_(name), access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), file_(open(image), H5Fclose) {
    check(file_);
  }

  void append(const std::string& path, const std::string& dimension, int components,
              const std::vector<double>& values, std::size_t rows_before) {
    const hsize_t rows = values.size() / static_cast<std::size_t>(components);
    const hsize_t start[] = {rows_before, 0}, count[] = {rows, static_cast<hsize_t>(components)};
    const hsize_t size[] = {rows_before + rows, count[1]};
    const int rank = components == 1 ? 1 : 2;
    const bool is_there = rows_before > 0 && exists(path);
    Hdf5Handle dataset(is_there ? H5Dopen2(file_, path.c_str(), H5P_DEFAULT) : create(path, rank, size),
                       H5Dclose);
    check(dataset);
    if (is_there)
      check(H5Dset_extent(dataset, size));
    else
      set_text(dataset, "dimension", dimension);
    Hdf5Handle space(H5Dget_space(dataset), H5Sclose),
        memory(H5Screate_simple(rank, count, nullptr), H5Sclose);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr));
    check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()));
    check(dataset.close());
  }

  void set_title(const std::string& group, const std::string& title) {
    Hdf5Handle object(H5Oopen(file_, group.c_str(), H5P_DEFAULT), H5Oclose);
    check(object);
    if (H5Aexists(object, "title") <= 0) set_text(object, "title", title);
  }

  /// Rows of the longest dataset; `most` at most. Those behind are taken off, and datasets that are shorter,
  /// because a run that went on had nothing to say of them, get NaN. `gauges`: rows of each gauge, and on
  /// return those that are there.
  std::size_t cut(std::size_t most, std::map<std::string, std::int64_t>& gauges) {
    std::vector<std::string> paths;
    check(H5Ovisit(
        file_, H5_INDEX_NAME, H5_ITER_NATIVE,
        [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
          if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->emplace_back(name);
          return 0;
        },
        &paths));
    std::size_t rows = 0;
    for (const bool only_look : {true, false})
      for (const std::string& path : paths) {
        Hdf5Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
        check(dataset);
        Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
        hsize_t size[2] = {0, 0};
        check(H5Sget_simple_extent_dims(space, size, nullptr));
        if (const std::string gauge = gauge_of(path); !gauge.empty()) {
          std::int64_t& of_gauge = gauges[gauge];
          size[0] = std::min<hsize_t>(size[0], static_cast<hsize_t>(of_gauge));
          of_gauge = static_cast<std::int64_t>(size[0]);
          if (!only_look) check(H5Dset_extent(dataset, size));
          continue;
        }
        if (only_look) rows = std::min(most, std::max<std::size_t>(rows, size[0]));
        size[0] = rows;
        if (!only_look) check(H5Dset_extent(dataset, size));
      }
    return rows;
  }

  /// All bytes of the file.
  std::string image() {
    check(H5Fflush(file_, H5F_SCOPE_LOCAL));
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    check(size);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    check(H5Fget_file_image(file_, bytes.data(), bytes.size()));
    check(file_.close());
    return bytes;
  }

 private:
  hid_t open(const std::string& image) {
    constexpr std::size_t growth = 1 << 20;  // bytes
    H5Pset_fclose_degree(access_, H5F_CLOSE_STRONG);
    // H5Fget_file_image of HDF5 1.10 spoils the checksum that later formats have in their first block
    H5Pset_libver_bounds(access_, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
    H5Pset_fapl_core(access_, growth, false);
    const std::string name =
        name_.string() + ".in_memory";  // HDF5 refuses an image for a name that is on the disk
    if (image.empty()) return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_);
    // HDF5 copies the bytes; it asks for a mutable pointer all the same
    check(H5Pset_file_image(access_, const_cast<char*>(image.data()), image.size()));
    return H5Fopen(name.c_str(), H5F_ACC_RDWR, access_);
  }

  bool exists(const std::string& path) const {
    for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
      if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
  }

  hid_t create(const std::string& path, int rank, const hsize_t* size) {
    const bool is_of_gauge = path.starts_with(gauge_group);
    const hsize_t longest[] = {H5S_UNLIMITED, size[1]},
                  chunk[] = {is_of_gauge ? gauge_rows_of_chunk : chunk_rows, rank == 1 ? 1 : size[1]};
    const double missing = std::numeric_limits<double>::quiet_NaN();
    Hdf5Handle space(H5Screate_simple(rank, size, longest), H5Sclose),
        options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_chunk(options, rank, chunk);
    H5Pset_fill_value(options, H5T_NATIVE_DOUBLE, &missing);
    if (!is_of_gauge) H5Pset_shuffle(options), H5Pset_deflate(options, 4);
    H5Pset_create_intermediate_group(links, 1);
    return H5Dcreate2(file_, path.c_str(), H5T_IEEE_F64LE, space, links, options, H5P_DEFAULT);
  }

  void set_text(hid_t object, const char* name, const std::string& text) {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, std::max<std::size_t>(1, text.size()));
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(attribute);
    check(H5Awrite(attribute, type, text.empty() ? "\0" : text.c_str()));
  }

  void check(hid_t result) const {
    if (result >= 0) return;
    const std::string why = innermost_error();
    Hdf5Use::failed();
    throw OutputError(name_, why);
  }

  std::filesystem::path name_;
  Hdf5Handle access_, file_;
};

}  // namespace

History::History(std::filesystem::path file, std::size_t buffered_samples, std::chrono::seconds longest_wait)
    : file_(std::move(file)),
      buffered_samples_(buffered_samples),
      longest_wait_(longest_wait),
      wait_(longest_wait),
      last_flush_(std::chrono::steady_clock::now()) {}

std::size_t History::resume(std::size_t rows, const std::map<std::string, std::int64_t>& gauge_rows) {
  std::error_code none;
  if (!std::filesystem::exists(file_, none)) return 0;
  const Hdf5Use use(file_, 4 * std::filesystem::file_size(file_, none));
  HistoryFile h5(file_, content(file_));
  std::map<std::string, std::int64_t> of_gauges = gauge_rows;
  rows_in_file_ = h5.cut(rows, of_gauges);
  for (const auto& [name, count] : of_gauges) gauges_[name].rows_in_file = static_cast<std::size_t>(count);
  write_checked(file_, h5.image());
  return rows_in_file_;
}

void History::record(const Sample& sample) {
  put_global(sample);
  put_entities(sample);
  ++rows_;
  // where the last chunk is not whole it will have to be packed once more
  const bool is_whole = rows() % chunk_rows == 0 || buffered_samples_ < chunk_rows;
  if ((is_whole && rows_ >= buffered_samples_ && rows_ >= enough_rows()) ||
      std::chrono::steady_clock::now() - last_flush_ >= wait_)
    flush();
}

// The other flushes write what is buffered of gauges, too.
void History::record_gauge(const GaugeLayout& layout, Real t, const std::vector<Real>& values) {
  constexpr std::size_t most_rows = 8192;
  OwnRows& own = gauges_[layout.name];
  if (own.layout.columns.empty()) own.layout = layout;
  own.values.push_back(t);
  own.values.insert(own.values.end(), values.begin(), values.end());
  if (++own.rows >= most_rows || std::chrono::steady_clock::now() - last_flush_ >= wait_) flush();
}

std::vector<double> History::OwnRows::columns(std::size_t first, std::size_t count) const {
  const std::size_t width = values.size() / rows;
  std::vector<double> out;
  out.reserve(rows * count);
  for (std::size_t row = 0; row < rows; ++row) {
    const double* const begin = values.data() + row * width + first;
    out.insert(out.end(), begin, begin + count);
  }
  return out;
}

std::map<std::string, std::int64_t> History::gauge_rows() const {
  std::map<std::string, std::int64_t> out;
  for (const auto& [name, own] : gauges_) out[name] = static_cast<std::int64_t>(own.rows + own.rows_in_file);
  return out;
}

std::size_t History::bytes_buffered() const {
  std::size_t numbers = 0;
  for (const auto& [name, own] : gauges_) numbers += own.values.size();
  for (const auto& [path, c] : columns_) numbers += c.values.size();
  return sizeof(double) * numbers;
}

// Each flush writes all rows again: a larger file is left alone longer, as far as memory allows.
std::size_t History::enough_rows() const {
  std::size_t width = 0;
  for (const auto& [path, c] : columns_) width += static_cast<std::size_t>(c.components);
  return std::max(buffered_samples_,
                  std::min(rows_in_file_ / 8, most_buffered / std::max<std::size_t>(width, 1)));
}

void History::flush() {
  last_flush_ = std::chrono::steady_clock::now();
  const auto has_rows = [](const auto& gauge) { return gauge.second.rows > 0; };
  if (rows_ == 0 && std::none_of(gauges_.begin(), gauges_.end(), has_rows)) return;
  std::error_code none;
  const auto in_file = [](const auto& gauge) { return gauge.second.rows_in_file > 0; };
  const bool begun = rows_in_file_ > 0 || std::any_of(gauges_.begin(), gauges_.end(), in_file);
  const std::size_t before = begun ? std::filesystem::file_size(file_, none) : 0;
  constexpr std::size_t of_dataset = 8192;
  const Hdf5Use use(file_, 4 * (before + bytes_buffered()) + columns_.size() * of_dataset);
  HistoryFile h5(file_, begun ? content(file_) : std::string());
  for (auto& [path, c] : columns_) {
    if (rows_ == 0) break;
    c.values.resize(rows_ * static_cast<std::size_t>(c.components), std::numeric_limits<double>::quiet_NaN());
    h5.append(path, c.dimension, c.components, c.values, rows_in_file_);
  }
  for (auto& [name, samples] : gauges_) {
    if (samples.rows == 0) continue;
    const std::string group = std::string(gauge_group) + name;
    auto& own = samples;  // clang 14 captures no names of a structured binding
    std::size_t first = 0;
    const auto append = [&](const std::string& column, const std::string& dimension, int components) {
      const auto count = static_cast<std::size_t>(components);
      h5.append(group + "/" + column, dimension, components, own.columns(first, count), own.rows_in_file);
      first += count;
    };
    append("time", "T", 1);
    for (const GaugeLayout::Column& c : own.layout.columns) append(c.name, c.dimension, c.components);
    if (!own.layout.title.empty()) titles_[group] = own.layout.title;
  }
  for (const auto& [group, title] : titles_) h5.set_title(group, title);
  write_checked(file_, h5.image());
  for (auto& [path, c] : columns_) c.values.clear();
  for (auto& [name, own] : gauges_) own.rows_in_file += own.rows, own.rows = 0, own.values.clear();
  rows_in_file_ += rows_;
  rows_ = 0;
  // A large file takes long to write again: not more than half a hundredth of the time goes there.
  const auto now = std::chrono::steady_clock::now();
  wait_ = std::max<std::chrono::steady_clock::duration>(longest_wait_, 200 * (now - last_flush_));
}

}  // namespace courant
