#include "post/history_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "output/hdf5.hpp"
#include "output/history_checksum.hpp"

namespace courant {
/// Values of a dataset as they lie in the file; shape: (rows, components).
struct HistoryDataset {
  int components = 0;
  std::vector<Real> values;
  std::string dimension = "-";
};

namespace {

/// The attribute `dimension`, a text of fixed length.
std::string dimension_of(hid_t dataset) {
  if (H5Aexists(dataset, "dimension") <= 0) return "-";
  const Hdf5Handle attribute(H5Aopen(dataset, "dimension", H5P_DEFAULT), H5Aclose);
  if (attribute < 0) return "-";
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return "-";
  constexpr std::size_t longest = 1000;
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Tget_size(type) > longest) return "-";  // a damaged file
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return "-";
  return text.c_str();
}

bool is_whole(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  return take_history_checksum(bytes);
}

herr_t note_dataset(hid_t, const char* name, const H5O_info_t* info, void* to) {
  if (info->type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string>*>(to)->push_back(std::string("/") + name);
  return 0;
}

std::optional<HistoryDataset> load(hid_t file, const std::string& path) {
  const Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) return std::nullopt;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 0) return std::nullopt;
  HistoryDataset out{static_cast<int>(size[1]), std::vector<Real>(size[0] * size[1]), dimension_of(dataset)};
  if (!out.values.empty() &&
      H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.values.data()) < 0)
    return std::nullopt;
  return out;
}

}  // namespace

struct HistoryFile::Content {
  std::map<std::string, HistoryDataset> datasets;
  std::vector<std::string> names;
  std::size_t rows = 0;
};

HistoryFile::HistoryFile(std::unique_ptr<Content> content) : content_(std::move(content)) {}
HistoryFile::HistoryFile(HistoryFile&&) noexcept = default;
HistoryFile& HistoryFile::operator=(HistoryFile&&) noexcept = default;
HistoryFile::~HistoryFile() = default;

std::optional<HistoryFile> HistoryFile::open(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const Hdf5Silence silence;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    diagnostics.error({file.string()}, "no histories here: the file is missing",
                      "the deck needs a *DATABASE_GLSTAT card");
    return std::nullopt;
  }
  if (!is_whole(file)) {
    diagnostics.error({file.string()},
                      "not a history file of `courant run`, or a damaged one: its checksum is not "
                      "that of its content",
                      "run the deck again");
    return std::nullopt;
  }
  const Hdf5Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  auto content = std::make_unique<Content>();
  bool whole = h5 >= 0 && H5Ovisit(h5, H5_INDEX_NAME, H5_ITER_INC, note_dataset, &content->names) >= 0;
  for (const std::string& name : content->names) {
    auto dataset = load(h5, name);
    whole = whole && dataset;
    if (dataset) content->datasets.emplace(name, std::move(*dataset));
  }
  const auto time = content->datasets.find("/global/time");
  if (!whole || time == content->datasets.end()) {
    diagnostics.error({file.string()}, "not a history file of `courant run`", "run the deck again");
    return std::nullopt;
  }
  content->rows = time->second.values.size();
  std::sort(content->names.begin(), content->names.end());
  return HistoryFile(std::move(content));
}

const std::vector<std::string>& HistoryFile::names() const {
  return content_->names;
}

int HistoryFile::components(const std::string& path) const {
  const auto found = content_->datasets.find(path);
  return found == content_->datasets.end() ? 0 : found->second.components;
}

std::string HistoryFile::dimension(const std::string& path) const {
  const auto found = content_->datasets.find(path);
  return found == content_->datasets.end() ? "-" : found->second.dimension;
}

std::optional<std::vector<Real>> HistoryFile::column(const std::string& path, int component) const {
  const auto found = content_->datasets.find(path);
  if (found == content_->datasets.end() || component < 0 || component >= found->second.components)
    return std::nullopt;
  const HistoryDataset& data = found->second;
  const auto width = static_cast<std::size_t>(data.components);
  // rows before a dataset was there are not in the file
  std::vector<Real> out(content_->rows, std::nan(""));
  const std::size_t rows = std::min(content_->rows, data.values.size() / width);
  for (std::size_t i = 0; i < rows; ++i)
    out[i] = data.values[i * width + static_cast<std::size_t>(component)];
  return out;
}

std::vector<char> HistoryFile::sampled(const std::string& path) const {
  std::vector<char> out(content_->rows, 0);
  const std::string group = path.substr(0, path.rfind('/') + 1);
  for (const auto& [name, data] : content_->datasets) {
    if (!name.starts_with(group)) continue;
    const auto width = static_cast<std::size_t>(data.components);
    for (std::size_t i = 0; i < std::min(out.size() * width, data.values.size()); ++i)
      if (!std::isnan(data.values[i])) out[i / width] = 1;
  }
  return out;
}

}  // namespace courant
