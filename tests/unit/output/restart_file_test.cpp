#include "output/restart_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <numeric>
#include <sstream>

#include "../temporary_folder.hpp"
#include "output/folder_lock.hpp"
#include "output/hdf5.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

class RestartFiles : public test::TemporaryFolder {
 protected:
  static SavedState state() {
    SavedState out;
    Archive archive = Archive::saver(out);
    const Archive::Group group(archive, "a group/with blanks in it");
    std::vector<Real> numbers(3000), none;
    std::iota(numbers.begin(), numbers.end(), -0.0);
    numbers[7] = std::numeric_limits<Real>::quiet_NaN();
    std::vector<Index> few{1, -2, 3};
    std::string text = "\xc3\xa4, \x01";
    bool yes = true;
    archive("numbers", numbers);
    archive("none", none);
    archive("few", few);
    archive("text", text);
    archive("yes", yes);
    archive.rows("rows", std::vector<Real*>{numbers.data(), numbers.data() + 1000}, 1000);
    return out;
  }
  static void expect_same(const SavedState& a, const SavedState& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [path, array] : a) {
      ASSERT_TRUE(b.contains(path)) << path;
      EXPECT_EQ(array.type, b.at(path).type) << path;
      EXPECT_EQ(array.rows, b.at(path).rows) << path;
      EXPECT_EQ(array.bytes, b.at(path).bytes) << path;
    }
  }
  static std::string fault(const fs::path& file) {
    try {
      read_restart_file(file);
    } catch (const RestartError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(RestartFiles, GiveBackEveryBit) {
  SavedState written = state();
  write_restart_file(folder_ / "a.h5", written, 12);
  EXPECT_FALSE(fs::exists(folder_ / "a.h5.tmp"));
  expect_same(read_restart_file(folder_ / "a.h5"), state());
}

TEST_F(RestartFiles, AreRefusedForOneWrongBitAnywhere) {
  SavedState written = state();
  const fs::path file = folder_ / "a.h5";
  write_restart_file(file, written, 12);
  std::ifstream stream(file, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  const std::string whole = bytes.str();
  for (std::size_t at = 0; at < whole.size(); at += at + 160 < whole.size() ? 509 : 2) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ 1 << at % 8);
    std::ofstream(file, std::ios::binary) << broken;
    EXPECT_NE(fault(file), "") << "byte " << at;
  }
  for (const std::size_t length : {std::size_t(0), std::size_t(100), whole.size() - 1}) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    EXPECT_NE(fault(file), "") << length << " bytes";
  }
  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_EQ(fault(file), "");
}

/// A file whose checksum holds, but whose array claims numbers that nobody wrote.
TEST_F(RestartFiles, AskForNoMoreMemoryThanTheyCanFill) {
  const fs::path image = folder_ / "image.h5", file = folder_ / "a.h5";
  {
    const hsize_t size[] = {1, hsize_t(1) << 40}, chunk[] = {1, 1 << 16};
    const Hdf5Handle h5(H5Fcreate(image.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle space(H5Screate_simple(2, size, nullptr), H5Sclose);
    const Hdf5Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(options, 2, chunk);
    const Hdf5Handle dataset(H5Dcreate2(h5, "huge", H5T_IEEE_F64LE, space, H5P_DEFAULT, options, H5P_DEFAULT),
                             H5Dclose);
    ASSERT_GE(hid_t(dataset), 0);
  }
  std::ifstream stream(image, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  SavedState none;
  write_restart_file(file, none, 3);  // for the form of the last line
  std::ifstream whole(file, std::ios::binary);
  std::stringstream written;
  written << whole.rdbuf();
  const std::string last = written.str().substr(written.str().size() - 74);
  std::string crafted = bytes.str() + last.substr(0, 65);
  const auto crc =
      ::crc32(0, reinterpret_cast<const Bytef*>(crafted.data()), static_cast<uInt>(crafted.size()));
  crafted += fmt::format("{:08x}\n", crc);
  std::ofstream(file, std::ios::binary) << crafted;
  EXPECT_NE(fault(file).find("HDF5 cannot read 'huge'"), std::string::npos) << fault(file);
}

TEST_F(RestartFiles, AreListedFromTheLatestOn) {
  for (const int cycle : {5, 120, 40}) {
    SavedState written = state();
    write_restart_file(folder_ / (std::to_string(cycle) + ".h5"), written, cycle);
  }
  std::ofstream(folder_ / "other.h5") << "no restart file";
  const auto files = restart_files(folder_);
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].cycle, 120);
  EXPECT_EQ(files[1].cycle, 40);
  EXPECT_EQ(files[2].file, folder_ / "5.h5");
  EXPECT_TRUE(restart_files(folder_ / "nowhere").empty());
}

TEST_F(RestartFiles, KeepTheOldOneWhereTheNewOneCannotBeWritten) {
  SavedState written = state();
  write_restart_file(folder_ / "a.h5", written, 1);
  fs::create_directory(folder_ / "a.h5.tmp");  // nobody can open this as a file
  SavedState again = state();
  EXPECT_THROW(write_restart_file(folder_ / "a.h5", again, 2), OutputError);
  ASSERT_EQ(restart_files(folder_).size(), 1u);
  EXPECT_EQ(restart_files(folder_)[0].cycle, 1);
  expect_same(read_restart_file(folder_ / "a.h5"), state());
}

TEST_F(RestartFiles, OneRunInAFolder) {
  const auto refused = [&] {
    try {
      const FolderLock second(folder_);
    } catch (const OutputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  {
    const FolderLock first(folder_);
    EXPECT_NE(refused().find("another run (process " + std::to_string(getpid()) + ") is writing there"),
              std::string::npos);
  }
  EXPECT_EQ(refused(), "");
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace courant
